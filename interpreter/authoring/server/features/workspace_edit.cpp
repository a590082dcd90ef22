#include "authoring/server/features/workspace_edit.h"

#include <vector>

namespace lockstep::host {

Json json_of(const TextEdit& edit, const Positions& positions) {
  std::vector<Json> edits;
  for (const Patch& it : edit.patches()) {
    edits.push_back(
        Json{{"range", positions.json(ByteRange{it.begin, it.end})}, {"newText", it.text}});
  }
  return Json::array(std::move(edits));
}

Json workspace_edit(const std::map<std::string, Json>& edits) {
  Json changes = Json::object();
  for (const auto& [uri, edit] : edits) changes[uri] = edit;
  return {{"changes", std::move(changes)}};
}

}  // namespace lockstep::host
