#include "author/server/features/workspace_edit.h"

#include <vector>

#include "language/document/byte_order_mark.h"

namespace lockstep::host {
namespace {

// null: the version on the disk.
Json version_of(const Workspace& workspace, const std::string& uri) {
  const auto file = workspace.files().find(uri);
  return file == workspace.files().end() ? Json() : Json(file->second.version);
}

}  // namespace

std::optional<ProjectTexts> project_texts(const Question& question) {
  const auto& project = question.file.analysis->project;
  const std::string_view text = question.file.bytes();
  if (!project ||
      project->documents.front()->source()->text() != text.substr(byte_order_mark(text).size()))
    return std::nullopt;
  return ProjectTexts(*project, question.file.analysis->catalog);
}

Json json_of(const TextEdit& edit, const Positions& positions) {
  std::vector<Json> edits;
  for (const Patch& it : edit.patches()) {
    edits.push_back(
        Json{{"range", positions.json(ByteRange{it.begin, it.end})}, {"newText", it.text}});
  }
  return Json::array(std::move(edits));
}

Json json_of_document(const TextEdit& edit, std::string_view text) {
  const std::size_t mark = byte_order_mark(text).size();
  TextEdit moved;
  for (Patch& it : edit.patches())
    moved.replace(it.begin + mark, it.end + mark, std::move(it.text));
  return json_of(moved, Positions(text));
}

Json workspace_edit(const Question& question, const std::map<std::string, Json>& edits) {
  if (!question.client.has_document_changes) {
    Json changes = Json::object();
    for (const auto& [uri, edit] : edits) changes[uri] = edit;
    return {{"changes", std::move(changes)}};
  }
  std::vector<Json> changes;
  for (const auto& [uri, edit] : edits) {
    Json document{{"uri", uri}, {"version", version_of(question.workspace, uri)}};
    changes.push_back(Json{{"textDocument", std::move(document)}, {"edits", edit}});
  }
  return {{"documentChanges", Json::array(std::move(changes))}};
}

ChangedFile changed_file(const Question& question, const Source& source) {
  ChangedFile changed{.uri = question.workspace.uri_of(source.path()), .open = {}};
  const auto file = question.workspace.files().find(changed.uri);
  if (file != question.workspace.files().end()) changed.open = file->second.bytes();
  return changed;
}

Json workspace_edit(const Question& question, const ProjectTexts& texts, const ProjectEdit& edit) {
  std::map<std::string, Json> changes;
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    if (edit[i].empty()) continue;
    const Source& source = *texts.document(i).source();
    const auto [uri, open] = changed_file(question, source);
    changes[uri] = json_of_document(edit[i], open ? *open : std::string_view(source.text()));
  }
  return workspace_edit(question, changes);
}

}  // namespace lockstep::host
