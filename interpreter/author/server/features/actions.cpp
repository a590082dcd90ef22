#include "author/server/features/actions.h"

#include <algorithm>
#include <utility>

#include "author/server/features/refactorings.h"
#include "author/server/features/workspace_edit.h"
#include "tree/mend/mends.h"

namespace lockstep::host {
namespace {

std::vector<Json> quick_fixes(const Question& question) {
  const Positions& positions = question.file.positions();
  const TolerantTree& tree = question.file.tree();
  ByteRange wanted{0, tree.text.size()};
  if (const auto& range = question.params.range)
    wanted = {positions.byte_at(range->first), positions.byte_at(range->second)};
  const Mends mends(tree, question.file.analysis->catalog);
  std::vector<Json> actions;
  for (const Diagnostic& message : question.file.analysis->diagnostics) {
    if (message.location.file != question.file.path) continue;
    const ByteRange place = mends.place_of(message);
    if (place.end < wanted.begin || place.begin > wanted.end) continue;
    bool is_best = true;
    for (Mend& it : mends.of(message)) {
      Json change = workspace_edit(question, {{question.file.uri, json_of(it.edit, positions)}});
      actions.push_back(Json{{"title", std::move(it.title)},
                             {"kind", "quickfix"},
                             {"isPreferred", std::exchange(is_best, false)},
                             {"edit", std::move(change)}});
    }
  }
  return actions;
}

}  // namespace

bool is_wanted(std::string_view kind, const std::vector<std::string>& kinds) {
  return kinds.empty() || std::ranges::any_of(kinds, [&](std::string_view it) {
           const bool begins = it.empty() || kind.starts_with(it);
           return begins && (it.empty() || it.size() == kind.size() || kind[it.size()] == '.');
         });
}

Json code_actions(const Question& question) {
  std::vector<Json> actions;
  if (is_wanted("quickfix", question.params.kinds)) actions = quick_fixes(question);
  for (Json& it : refactorings(question)) actions.push_back(std::move(it));
  return Json::array(std::move(actions));
}

}  // namespace lockstep::host
