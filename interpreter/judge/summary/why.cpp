#include "judge/summary/why.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// Only the value that it has now. None: it has none, or one that is too long to be shown.
std::optional<std::string> text_of(const Moment& moment, std::uint32_t entry) {
  if (moment.live == nullptr) return moment.texts[entry].text;
  const Value& value = moment.entries[entry].value();
  if (std::holds_alternative<NoValue>(value)) return std::nullopt;
  return to_text(value);
}

std::uint32_t writes_of(const Moment& moment, std::uint32_t entry) {
  return moment.live == nullptr ? moment.texts[entry].writes : moment.entries[entry].changes();
}

constexpr std::string_view kStoodStill = "it stood still (--stall-fail)";

// A leaf has one reason in a tick, which is that of the last attempt. Those before it are one row.
void add_attempt(std::vector<Attempt>& all, Attempt it) {
  const auto joins = [](Attempt& row, const Attempt& next) {
    const bool is_same = row.tick == next.tick && row.node == next.node;
    if (!is_same || !row.reason.empty() || !next.reason.empty()) return false;
    row.times += next.times;
    return true;
  };
  if (!all.empty() && all.back().tick == it.tick) {
    all.back().reason.clear();
    if (all.size() > 1 && joins(all[all.size() - 2], all.back())) all.pop_back();
    if (joins(all.back(), it)) return;
  }
  if (all.size() == WhyWatch::kAttempts) all.erase(all.begin());
  all.push_back(std::move(it));
}

}  // namespace

WhyWatch::WhyWatch(const Shape& shape) : shape_(shape) {
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    const ShapeNode& it = shape.nodes[node];
    for (const std::string& key : it.reads) {
      const auto entry = std::ranges::find(shape.entries, key, &ShapeEntry::key);
      if (entry == shape.entries.end()) continue;  // it is not in the recording
      const auto place = static_cast<std::uint32_t>(entry - shape.entries.begin());
      const bool is_known = std::ranges::find(watched_, place, &Watched::entry) != watched_.end();
      if (is_known) continue;
      watched_.push_back({.entry = place});
      watched_.back().writers.reserve(entry->writers.size());
    }
    if (it.children.size() != 1) continue;
    if (it.tries_again) {
      tries_.push_back({.node = node, .child = it.children.front()});
      tries_.back().last.reserve(kAttempts);
    }
    if (it.limits_time) {
      timed_.push_back({.node = node});
      timed_.back().reason.reserve(kMostOfReason);
    }
  }
  for (const NodeIndex user : users_of_pools(shape)) users_.push_back({.node = user});
  if (!asked().within) return;
  column_.reserve(shape.nodes.size());
  activity_.resize(shape.nodes.size());
  reached_.resize(shape.nodes.size());
}

// A node may begin several attempts in a tick.
AskedOfRun WhyWatch::asked() const {
  return {.within = !tries_.empty()};
}

void WhyWatch::after_tick(const Moment& moment) {
  const bool is_later_part = !has_begun_ && moment.tick > 0;
  for (Watched& it : watched_) {
    const std::uint32_t writes = writes_of(moment, it.entry);
    if (writes == it.writes) continue;
    it.writes = writes;
    if (moment.live != nullptr) {
      const Value& now = moment.entries[it.entry].value();
      if (now == it.value) continue;
      it.value = now;
    }
    it.tick = moment.tick;
    it.writers.clear();
    if (is_later_part) it.tick.reset();
    if (is_later_part) continue;
    for (const NodeIndex writer : shape_.entries[it.entry].writers) {
      if (moment.ticked(writer)) it.writers.push_back(writer);
    }
    if (!has_begun_ && it.writers.empty()) it.tick.reset();  // the value of the start
  }
  has_begun_ = true;
  for (User& it : users_) {
    const bool runs = moment.status(it.node) == Status::Running;
    const ResourceSet owned = runs ? owned_set(moment.limit(it.node)) : 0;
    if ((owned & ~it.owned) != 0) it.since = moment.tick;
    it.owned = owned;
  }
  follow_stalls(moment);
  for (Timed& it : timed_) follow_time(moment, it, is_later_part);
  if (!tries_.empty()) follow_attempts(moment, is_later_part);
}

// Allocates only where a node stood still.
void WhyWatch::follow_stalls(const Moment& moment) {
  std::erase_if(stood_still_, [&](NodeIndex node) { return moment.ticked(node); });
  stood_still_.insert(stood_still_.end(), moment.stood_still.begin(), moment.stood_still.end());
}

// What was ended so has no child that decided: it may have begun again in the same tick.
bool WhyWatch::stood_still(const Moment& moment, NodeIndex node) const {
  return moment.status(node) == Status::Failure && !deciding_child(shape_, moment, node) &&
         std::ranges::find(stood_still_, node) != stood_still_.end();
}

// Of what runs in it, since its end ends that, too. Allocates only where a pool is waited for.
void WhyWatch::follow_time(const Moment& moment, Timed& timed, bool is_later_part) const {
  const bool ran = timed.runs;
  timed.runs = moment.status(timed.node) == Status::Running;
  if (!ran && moment.ticked(timed.node)) {
    timed.began = is_later_part ? std::nullopt : std::optional(moment.time);
    timed.waiting = 0;
  }
  if (!timed.runs) return;
  const auto is_in_it = [&](NodeIndex node) {
    return timed.node < node && node < shape_.nodes[timed.node].end &&
           moment.status(node) == Status::Running;
  };
  for (const User& it : users_) {
    const double limit = moment.limit(it.node);
    if (!is_in_it(it.node) || !waits(limit)) continue;
    if (timed.waiting == it.node && timed.limit == limit) return;
    timed.waiting = it.node;
    timed.limit = limit;
    timed.reason = owner_text(moment, it.node);
    return;
  }
  timed.limit = 0;
  const auto it = std::ranges::find_if(moment.reasons, [&](const Reason& reason) {
    return is_in_it(reason.node) && moment.holds(reason);
  });
  timed.waiting = it == moment.reasons.end() ? 0 : it->node;
  if (timed.waiting != 0) timed.reason = it->text;
}

void WhyWatch::follow_attempts(const Moment& moment, bool is_later_part) {
  if (moment.within.empty()) {
    for (Tries& it : tries_) follow_attempt(moment, moment, it, 1, is_later_part);
    return;
  }
  Moment part = moment;
  part.activity = activity_;
  part.reached = reached_;
  part.number = 1;
  moment.within.each(column_, [&](std::span<const NodeState> states, const TickMoment& of, bool) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      activity_[i] = states[i].activity();
      reached_[i] = states[i].ticked() ? 1 : 0;
    }
    for (Tries& it : tries_) follow_attempt(moment, part, it, of.times, is_later_part);
  });
  // The order of the rest is not known.
  for (const NodeTotals& rest : moment.within.rest) {
    const auto it = std::ranges::find(tries_, rest.node, &Tries::child);
    if (it == tries_.end() || rest.of(Status::Failure) == 0) continue;
    it->runs = moment.status(it->node) == Status::Running;
    note_attempt(moment, moment, *it, rest.of(Status::Failure));
  }
}

void WhyWatch::follow_attempt(const Moment& moment, const Moment& part, Tries& tries,
                              std::uint64_t times, bool is_later_part) const {
  const bool ran = tries.runs;
  tries.runs = part.status(tries.node) == Status::Running;
  if (!part.ticked(tries.node)) return;
  if (!ran) {
    tries.failed = 0;
    tries.last.clear();
    tries.since = is_later_part ? std::optional(moment.tick) : std::nullopt;
  }
  const bool has_failed = part.ticked(tries.child) && part.status(tries.child) == Status::Failure;
  if (has_failed) note_attempt(moment, part, tries, times);
}

void WhyWatch::note_attempt(const Moment& moment, const Moment& part, Tries& tries,
                            std::uint64_t times) const {
  tries.failed += times;
  NodeIndex node = tries.child;
  while (const auto child = deciding_child(shape_, part, node)) node = *child;
  if (times > 1) add_attempt(tries.last, {.tick = moment.tick, .node = node, .times = times - 1});
  Attempt last{.tick = moment.tick, .node = node};
  if (stood_still(part, node))
    last.reason = kStoodStill;
  else if (moment.status(node) == part.status(node))
    last.reason = reason(moment, node);
  add_attempt(tries.last, std::move(last));
}

std::string WhyWatch::value_text(const Moment& moment, const std::string& key) const {
  const auto entry = std::ranges::find(shape_.entries, key, &ShapeEntry::key);
  if (entry == shape_.entries.end()) return {};
  const auto place = static_cast<std::uint32_t>(entry - shape_.entries.begin());
  const auto text = text_of(moment, place);
  const bool is_long = !text && writes_of(moment, place) > 0 && moment.live == nullptr;
  if (!text && !is_long) return fmt::format("{} has no value", key);
  std::string all =
      fmt::format("{} is {}", key, is_long ? "too long to be recorded" : brief(*text));
  const auto it = std::ranges::find(watched_, place, &Watched::entry);
  if (it == watched_.end() || !it->tick) return all;
  all += fmt::format(", since tick {}", *it->tick);
  constexpr std::size_t kMostNamed = 3;
  if (it->writers.size() > kMostNamed) return all;
  std::string_view before = " by ";
  for (const NodeIndex writer : it->writers) {
    all += fmt::format("{}'{}'", before, shape_.nodes[writer].path);
    before = " or ";
  }
  return all;
}

std::string WhyWatch::condition_text(const Moment& moment, NodeIndex node) const {
  const ShapeNode& it = shape_.nodes[node];
  const Status status = moment.status(node);
  const std::string_view is = status == Status::Success ? "is true" : "is false";
  std::string text = fmt::format("{} {}", it.condition, is);
  std::string_view before = ": ";
  for (const std::string& key : it.reads) {
    const std::string value = value_text(moment, key);
    if (value.empty()) continue;
    text += before;
    text += value;
    before = "; ";
  }
  const bool is_new = std::ranges::any_of(watched_, [&](const Watched& watched) {
    const bool is_read =
        std::ranges::find(it.reads, shape_.entries[watched.entry].key) != it.reads.end();
    return is_read && watched.tick == moment.tick;
  });
  if (is_new) text += " (at the end of the tick)";
  return text;
}

std::string WhyWatch::time_text(const Moment& moment, NodeIndex node) const {
  const auto it = std::ranges::find(timed_, node, &Timed::node);
  const NodeIndex child = shape_.nodes[node].children.front();
  const bool is_over =
      moment.status(node) == Status::Failure && moment.status(child) != Status::Failure;
  if (it == timed_.end() || !is_over) return {};
  std::string text = "its time was over";
  if (it->began) {
    text += fmt::format(", {:.3g} s after its start", to_seconds(moment.time - *it->began));
  }
  if (it->waiting != 0) {
    text += fmt::format("; before that, {}: {}", shape_.nodes[it->waiting].segment, it->reason);
    return text;
  }
  // Of those that were on their way, if the run is asked for it. That is before the tick.
  constexpr std::size_t kMostNamed = 4;
  std::size_t named = 0;
  for (NodeIndex leaf = node + 1; leaf < shape_.nodes[node].end && named < kMostNamed; ++leaf) {
    const double at = moment.progress.empty() ? 0 : moment.progress[leaf];
    if (!shape_.nodes[leaf].children.empty() || at <= 0 || at >= 1) continue;
    text += fmt::format("{} {} at {:.3g}", named++ == 0 ? "; before that," : ",",
                        shape_.nodes[leaf].segment, at);
  }
  return text;
}

std::string WhyWatch::reason(const Moment& moment, NodeIndex node) const {
  if (stood_still(moment, node)) return std::string(kStoodStill);
  if (const std::string_view own = moment.reason(node); !own.empty()) return std::string(own);
  const ShapeNode& it = shape_.nodes[node];
  if (!it.condition.empty() && moment.status(node) != Status::Idle) {
    return condition_text(moment, node);
  }
  if (it.limits_time) return time_text(moment, node);
  const bool is_user = std::ranges::find(users_, node, &User::node) != users_.end();
  const bool is_denied =
      is_user && moment.status(node) == Status::Running && waits(moment.limit(node));
  return is_denied ? owner_text(moment, node) + words_of_owners(moment, node) : std::string();
}

std::vector<WhyWatch::User> WhyWatch::owners(const Moment& moment, NodeIndex user) const {
  const double limit = moment.limit(user);
  const ResourceSet wanted = resource_set(limit) & ~owned_set(limit);
  std::vector<User> owners;
  for (const User& it : users_) {
    const bool is_of_pool = shape_.nodes[it.node].group == shape_.nodes[user].group;
    if (is_of_pool && it.node != user && (it.owned & wanted) != 0) {
      owners.push_back({.node = it.node, .owned = it.owned & wanted, .since = it.since});
    }
  }
  return owners;
}

// "waits for crane_2 of the pool cranes, which Main/left owns since tick 31".
std::string WhyWatch::owner_text(const Moment& moment, NodeIndex user) const {
  const ShapeNode& pool = shape_.nodes[*shape_.nodes[user].group];
  const double limit = moment.limit(user);
  const ResourceSet wanted = resource_set(limit) & ~owned_set(limit);
  std::string text =
      fmt::format("waits for {} of the pool {}", to_text(wanted, pool.resources), pool.name);
  std::string_view before = ", ";
  for (const User& it : owners(moment, user)) {
    const bool is_all = it.owned == wanted;
    text += fmt::format("{}{}'{}' owns {}since tick {}", before,
                        before == ", " ? (is_all ? "which " : "of which ") : "",
                        shape_.nodes[it.node].path,
                        is_all ? "" : to_text(it.owned, pool.resources) + ' ', it.since);
    before = ", and ";
  }
  return text;
}

// What runs in the owners, and what that waits for itself.
std::string WhyWatch::words_of_owners(const Moment& moment, NodeIndex user) const {
  std::string text;
  for (const User& it : owners(moment, user)) {
    for (const Reason& reason : moment.reasons) {
      const bool is_in_it = it.node < reason.node && reason.node < shape_.nodes[it.node].end;
      if (!is_in_it || !moment.holds(reason) || moment.status(reason.node) != Status::Running) {
        continue;
      }
      text += fmt::format("; '{}' there: {}", shape_.nodes[reason.node].segment, reason.text);
      break;
    }
  }
  return text;
}

// Such as the alternatives of a Fallback, which may have failed in earlier ticks.
std::vector<Attempt> WhyWatch::others(const Moment& moment, const DecidingNode& node) const {
  std::vector<Attempt> others;
  const auto decided = deciding_child(shape_, moment, node.node);
  if (node.agreeing < 2 || !decided) return others;
  for (const NodeIndex child : shape_.nodes[node.node].children) {
    if (child == *decided || moment.status(child) != node.status) continue;
    std::string its = reason(moment, child);
    NodeIndex who = child;
    while (its.empty() && !shape_.nodes[who].children.empty()) {
      const auto& children = shape_.nodes[who].children;
      const auto below = std::find_if(children.rbegin(), children.rend(), [&](NodeIndex it) {
        return moment.status(it) == node.status;
      });
      if (below == children.rend()) break;
      who = *below;
      its = reason(moment, who);
    }
    others.push_back({.tick = moment.tick, .node = who, .reason = std::move(its)});
  }
  return others;
}

std::vector<WhyLink> WhyWatch::why(const Moment& moment, NodeIndex node) const {
  struct Next {
    NodeIndex node;
    std::size_t depth;
  };
  std::vector<WhyLink> links;
  std::vector<Next> next{{node, 0}};
  while (!next.empty()) {
    const auto [self, depth] = next.back();
    next.pop_back();
    WhyLink& link = links.emplace_back(WhyLink{.decided = deciding_node(shape_, moment, self),
                                               .depth = depth,
                                               .is_held = moment.held(self),
                                               .stood_still = stood_still(moment, self),
                                               .reason = reason(moment, self)});
    link.others = others(moment, link.decided);
    if (const auto it = std::ranges::find(tries_, self, &Tries::node); it != tries_.end()) {
      link.failed_attempts = it->failed;
      link.attempts_since = it->since;
      link.attempts = it->last;
    }
    if (const auto child = deciding_child(shape_, moment, self)) {
      next.push_back({*child, depth + 1});
    } else if (link.decided.status == Status::Running) {
      const auto& children = shape_.nodes[self].children;
      for (auto it = children.rbegin(); it != children.rend(); ++it) {
        if (moment.status(*it) == Status::Running) next.push_back({*it, depth + 1});
      }
    }
  }
  return links;
}

}  // namespace lockstep::host
