// Changes of texts as the protocol has them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "author/edit/project_texts.h"
#include "author/server/features/feature.h"

namespace lockstep::host {

// The file and what it includes; nothing while the file cannot be read.
std::optional<ProjectTexts> project_texts(const Question& question);

Json json_of(const TextEdit& edit, const Positions& positions);
// The edit is one of the document of `text`, which leaves out its byte order mark.
Json json_of_document(const TextEdit& edit, std::string_view text);

// A file that is changed. `open`: its bytes in the editor, if it is open there.
struct ChangedFile {
  std::string uri;
  std::optional<std::string_view> open;
};
ChangedFile changed_file(const Question& question, const Source& source);

// The changes of several files, by their URIs; of the versions that are open, if the client knows
// that.
Json workspace_edit(const Question& question, const std::map<std::string, Json>& edits);
Json workspace_edit(const Question& question, const ProjectTexts& texts, const ProjectEdit& edit);

}  // namespace lockstep::host
