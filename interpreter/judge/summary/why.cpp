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
  return moment.live == nullptr ? moment.texts[entry].writes : moment.entries[entry].writes();
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
    if (it.limits_time) timed_.push_back({.node = node});
  }
}

void WhyWatch::after_tick(const Moment& moment) {
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
    for (const NodeIndex writer : shape_.entries[it.entry].writers) {
      if (moment.ticked(writer)) it.writers.push_back(writer);
    }
    if (!has_begun_ && it.writers.empty()) it.tick.reset();  // the value of the start
  }
  has_begun_ = true;
  for (Timed& it : timed_) {
    const bool ran = it.runs;
    it.runs = moment.status(it.node) == Status::Running;
    if (!ran && moment.ticked(it.node)) it.began = moment.time;
  }
  for (Tries& it : tries_) {
    const bool ran = it.runs;
    it.runs = moment.status(it.node) == Status::Running;
    if (!moment.ticked(it.node)) continue;
    if (!ran) {
      it.failed = 0;
      it.last.clear();
    }
    if (moment.ticked(it.child) && moment.status(it.child) == Status::Failure) {
      note_attempt(moment, it);
    }
  }
}

void WhyWatch::note_attempt(const Moment& moment, Tries& tries) const {
  ++tries.failed;
  NodeIndex node = tries.child;
  while (const auto child = deciding_child(shape_, moment, node)) node = *child;
  if (tries.last.size() == kAttempts) tries.last.erase(tries.last.begin());
  tries.last.push_back({.tick = moment.tick, .node = node, .reason = reason(moment, node)});
}

std::string WhyWatch::value_text(const Moment& moment, const std::string& key) const {
  const auto entry = std::ranges::find(shape_.entries, key, &ShapeEntry::key);
  if (entry == shape_.entries.end()) return {};
  const auto place = static_cast<std::uint32_t>(entry - shape_.entries.begin());
  const auto text = text_of(moment, place);
  if (!text && writes_of(moment, place) > 0 && moment.live == nullptr) {
    return fmt::format("{} has a value that is too long to be recorded", key);
  }
  if (!text) return fmt::format("{} has no value", key);
  std::string all = fmt::format("{} is {}", key, brief(*text));
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
  return fmt::format("its time was over, {:.3g} s after its start",
                     to_seconds(moment.time - it->began));
}

std::string WhyWatch::reason(const Moment& moment, NodeIndex node) const {
  if (const std::string_view own = moment.reason(node); !own.empty()) return std::string(own);
  const ShapeNode& it = shape_.nodes[node];
  if (!it.condition.empty() && moment.status(node) != Status::Idle) {
    return condition_text(moment, node);
  }
  return it.limits_time ? time_text(moment, node) : std::string();
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
                                               .reason = reason(moment, self)});
    link.others = others(moment, link.decided);
    if (const auto it = std::ranges::find(tries_, self, &Tries::node); it != tries_.end()) {
      link.failed_attempts = it->failed;
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
