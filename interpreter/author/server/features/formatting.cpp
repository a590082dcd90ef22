#include "author/server/features/formatting.h"

#include "author/format/format.h"
#include "author/server/features/workspace_edit.h"

namespace lockstep::host {

Json formatting(const Question& question) {
  const std::string& text = question.file.bytes();
  Diagnostics unused;
  const auto document = Document::parse(question.file.path, text, unused);
  if (document == nullptr) return {};
  const auto edit = format(*document);
  if (!edit) throw JsonError(edit.error().message);
  return json_of_document(*edit, text);
}

}  // namespace lockstep::host
