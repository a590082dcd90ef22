#include "verify/assumptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/wording.h"
#include "verify/labels.h"

namespace lockstep::host {
namespace {

std::string after_cuts(const LeafModels& models) {
  std::size_t go_on = 0, end = 0;
  for (const LeafModel& model : models.leaves) {
    if (!model.can_run) continue;
    const auto may = [&](AfterCut it) { return std::ranges::count(model.after_cut, it) > 0; };
    go_on += may(AfterCut::Continues);
    end += may(AfterCut::Failure) || may(AfterCut::Success);
  }
  std::string text = "a leaf that ran at a cut starts again";
  if (go_on > 0) {
    text += fmt::format(", or continues where it was ({})", counted(go_on, "action"));
  }
  if (end > 0) text += fmt::format(", or has a result at once ({})", counted(end, "action"));
  return text;
}

}  // namespace

std::vector<std::string> assumptions(const Tree& tree, const LeafModels& models, double rate,
                                     bool paces) {
  std::vector<std::string> assumed;
  assumed.push_back(fmt::format("ticks come at {} Hz", rate));
  if (models.cuts.most > 0) {
    assumed.push_back(fmt::format("the process is cut at most {} in a run, and loses no tick",
                                  counted(models.cuts.most, "time")));
    assumed.push_back(after_cuts(models));
  }
  std::size_t held = 0, by_parts = 0;
  std::set<std::uint32_t> parts;
  bool ends = false;
  for (const LeafModel& model : models.leaves) {
    const bool is_action = model.can_run;
    held += is_action && !model.drifts();
    ends |= is_action && model.ends;
    if (model.parts == 0) continue;
    ++by_parts;
    parts.insert(model.parts);
  }
  if (held > 0 && !holdable(tree).empty()) {
    assumed.push_back(fmt::format("held leaves make no progress ({})", counted(held, "action")));
  }
  const auto commits = [](const LeafNode& leaf) { return leaf.at_cut.commits; };
  if (const auto count = std::ranges::count_if(tree.leaves, commits); count > 0) {
    assumed.push_back(fmt::format("an action with commit waits for no disk ({})",
                                  counted(static_cast<std::uint64_t>(count), "action")));
  }
  if (ends) assumed.push_back("an action that is ticked again and again ends");
  if (paces) {
    assumed.push_back("times of Wait, Timeout and Delay count in full where pace slows them");
  }
  if (const auto count = std::ranges::count_if(models.leaves, &LeafModel::waits); count > 0) {
    assumed.push_back(
        fmt::format("programs answer before the next tick, so that on the wall clock their actions "
                    "take one tick more than in the leaf model ({})",
                    counted(static_cast<std::uint64_t>(count), "action")));
  }
  if (models.slowed > 0) {
    assumed.push_back(fmt::format("a slowed leaf may take longer than in its leaf model ({})",
                                  counted(models.slowed, "action")));
  }
  if (const std::size_t count = models.unstated_results; count > 0) {
    assumed.push_back(
        fmt::format("no leaf without result=\"…\" in the leaf model returns "
                    "Skipped ({} {})",
                    count, count == 1 ? "leaf" : "leaves"));
  }
  if (models.unstated_steps > 0) {
    assumed.push_back(
        fmt::format("no action without step=\"…\" in the leaf model loses progress while it is "
                    "ticked ({})",
                    counted(models.unstated_steps, "action")));
  }
  if (const std::size_t count = models.unstated_writes; count > 0) {
    assumed.push_back(
        fmt::format("no leaf without writes=\"…\" in the leaf model writes outside "
                    "of its ticks, or succeeds before its outputs have values "
                    "({} {})",
                    count, count == 1 ? "leaf" : "leaves"));
  }
  for (const std::uint32_t it : parts) {
    assumed.push_back(
        fmt::format("progress goes in steps of 1/{} ({})", it, counted(by_parts, "action")));
  }
  assumed.insert(assumed.end(), models.declared.begin(), models.declared.end());
  for (const Fact& fact : models.facts) {
    constexpr std::string_view kWords[] = {"does not change by itself", "changes freely",
                                           "changes from false to true at most",
                                           "changes from true to false at most"};
    std::string text =
        fmt::format("{} {}", fact.name, kWords[static_cast<std::size_t>(fact.changes)]);
    if (fact.starts) text += fmt::format(" and starts {}", *fact.starts);
    if (fact.chances[0] > 0) text += fmt::format(", true with a chance of {:.6g}", fact.chances[0]);
    assumed.push_back(std::move(text));
  }
  return assumed;
}

}  // namespace lockstep::host
