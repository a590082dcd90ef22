#include "authoring/server/features/formatting.h"

#include "authoring/format/format.h"
#include "authoring/server/features/workspace_edit.h"

namespace lockstep::host {

Json formatting(const Question& question) {
  const std::string& text = *question.file.text;
  Diagnostics unused;
  const auto document = Document::parse(question.file.path, text, unused);
  if (document == nullptr) return {};
  const auto edit = format(*document);
  if (!edit) throw JsonError(edit.error().message);
  // The document has no byte order mark.
  const std::size_t mark = text.size() - document->source()->text().size();
  TextEdit moved;
  for (Patch& it : edit->patches())
    moved.replace(it.begin + mark, it.end + mark, std::move(it.text));
  return json_of(moved, question.file.positions());
}

}  // namespace lockstep::host
