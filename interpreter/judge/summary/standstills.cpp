#include "judge/summary/standstills.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/resources.h"
#include "judge/summary/standstill_text.h"

namespace lockstep::host {

Standstills::Standstills(const Tree& tree, std::optional<Nanoseconds> limit, Tell tell)
    : tree_(tree), tell_(std::move(tell)) {
  if (limit) watch_.emplace(tree, *limit, [this](const Standstill& found) { report(found); });
}

void Standstills::before_tick(Ticker&, std::uint64_t, Nanoseconds) {
  failed_.clear();
}

void Standstills::after_tick(Ticker& ticker, const TickReport& report) {
  if (watch_) watch_->after_tick(ticker, report.time);
}

void Standstills::report(const Standstill& standstill) {
  add(standstill);
  tell_(standstill.link().node, standstill_lines(tree_, standstill));
}

void Standstills::failed(const Standstill& standstill, NodeIndex node) {
  failed_.push_back(node);
  const std::string path = tree_.path(node);
  auto lines = standstill_lines(tree_, standstill);
  StandstillSummary* known = find(standstill);
  if (known != nullptr) {
    lines = {fmt::format("{} is halted and fails: it stands still since {:.3f} s", path,
                         to_seconds(standstill.since))};
  } else {
    lines[0] = fmt::format("{} is halted and fails: {}", path, lines[0]);
    known = add(standstill);
  }
  if (known != nullptr) {
    known->failed = path;
    known->failed_at = to_seconds(standstill.time);
    known->lines.push_back(
        fmt::format("{} was halted and failed at {:.3f} s", path, to_seconds(standstill.time)));
  }
  tell_(node, lines);
}

// Null: there are too many.
StandstillSummary* Standstills::add(const Standstill& standstill) {
  if (++count_ > kMost) return nullptr;
  kept_.push_back({.node = standstill.link().node, .summary = summarize(standstill)});
  return &kept_.back().summary;
}

StandstillSummary* Standstills::find(const Standstill& standstill) {
  const double since = to_seconds(standstill.since);
  const auto it = std::ranges::find_if(kept_, [&](const Kept& kept) {
    return kept.node == standstill.link().node && kept.summary.since == since;
  });
  return it == kept_.end() ? nullptr : &it->summary;
}

StandstillSummary Standstills::summarize(const Standstill& standstill) const {
  StandstillSummary summary{.cause = standstill.chain.obstacle,
                            .since = to_seconds(standstill.since),
                            .reported = to_seconds(standstill.time),
                            .links = {},
                            .lines = standstill_lines(tree_, standstill)};
  for (const WaitLink& it : standstill.chain.links) {
    StandstillLinkSummary link{.node = tree_.path(it.node),
                               .kind = std::string(tree_.labels[it.node].type->id),
                               .waiting = tree_.path(it.waiting),
                               .awaited = tree_.path(it.awaited),
                               .waiting_at = it.waiting_at,
                               .awaited_at = it.awaited_at,
                               .awaited_status = it.awaited_status};
    if (is_pool(tree_, it.node)) {
      link.resources = to_text(it.resources, tree_.group(it.node).resources);
    }
    summary.links.push_back(std::move(link));
  }
  return summary;
}

void Standstills::add_to(Summary& summary) const {
  for (const Kept& it : kept_) summary.standstills.push_back(it.summary);
  summary.more_standstills = count_ - kept_.size();
  if (summary.why_failed.empty()) return;
  const std::string& last = summary.why_failed.back().path;
  summary.why_failed.back().stood_still =
      std::ranges::any_of(failed_, [&](NodeIndex node) { return tree_.path(node) == last; });
}

}  // namespace lockstep::host
