#include "judge/summary/standstills.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "judge/summary/standstill_text.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kIsFailed = " is halted and fails: ";  // behind the path

}  // namespace

bool tells_of_end(std::string_view path, std::string_view line) {
  return line.starts_with(path) && line.substr(path.size()).starts_with(kIsFailed);
}

Standstills::Standstills(Shape shape, std::optional<Nanoseconds> limit, Tell tell)
    : shape_(std::move(shape)), tell_(std::move(tell)) {
  if (limit) watch_.emplace(shape_, *limit, [this](const Standstill& found) { report(found); });
}

void Standstills::before_tick(const Moment&, std::uint64_t, Nanoseconds) {
  failed_.clear();
}

void Standstills::after_tick(const Moment& moment, const TickReport&) {
  if (watch_) watch_->after_tick(moment);
}

void Standstills::report(const Standstill& standstill) {
  add(standstill);
  tell_(standstill.link().node, standstill_lines(shape_, standstill));
}

void Standstills::failed(const Standstill& standstill, NodeIndex node) {
  failed_.push_back(node);
  const std::string path = shape_.nodes[node].path;
  auto lines = standstill_lines(shape_, standstill);
  StandstillSummary* known = find(standstill);
  if (known != nullptr) {
    lines = {fmt::format("{}{}no progress since {:.3f} s", path, kIsFailed,
                         to_seconds(standstill.since))};
  } else {
    lines[0] = fmt::format("{}{}{}", path, kIsFailed, lines[0]);
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
                            .lines = standstill_lines(shape_, standstill)};
  for (const WaitLink& it : standstill.chain.links) {
    StandstillLinkSummary link{.node = shape_.nodes[it.node].path,
                               .kind = shape_.nodes[it.node].kind,
                               .waiting = shape_.nodes[it.waiting].path,
                               .awaited = shape_.nodes[it.awaited].path,
                               .waiting_at = it.waiting_at,
                               .awaited_at = it.awaited_at,
                               .awaited_status = it.awaited_status};
    if (shape_.nodes[it.node].is_pool()) {
      link.resources = to_text(it.resources, shape_.nodes[it.node].resources);
    }
    summary.links.push_back(std::move(link));
  }
  return summary;
}

void Standstills::add_to(Summary& summary) const {
  for (const Kept& it : kept_) summary.standstills.push_back(it.summary);
  summary.more_standstills = count_ - kept_.size();
}

}  // namespace lockstep::host
