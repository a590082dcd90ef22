#include "record/read/since_cut.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// Those of a line, and of the nodes that it does not name: none.
template <class Change>
void with_the_others(std::span<const Change> line, const std::set<NodeIndex>& nodes,
                     std::vector<Change>& all) {
  all.assign(line.begin(), line.end());
  std::set<NodeIndex> left_out = nodes;
  for (const Change& it : line) left_out.erase(it.node);
  for (const NodeIndex node : left_out) all.emplace_back().node = node;
}

}  // namespace

void SinceCut::take(const RecordedTick& tick) {
  for (const RecordedEntry& it : tick.entries) {
    if (it.entry >= entries_.size()) entries_.resize(it.entry + 1);
    entries_[it.entry] = it;
  }
  for (const RecordedReason& it : tick.reasons) reasoned_.insert(it.node);
  for (const RecordedHeard& it : tick.heard) heard_from_.insert(it.node);
}

void SinceCut::cut(std::vector<RecordedState>& states, const Shape& shape) {
  for (NodeIndex node = 0; node < states.size(); ++node) {
    if (states[node] != RecordedState()) forgotten_.push_back(node);
    const bool has_limit = compares_progress(shape.nodes[node].synchronization);
    const bool is_known = std::ranges::find(limits_, node, &Limit::first) != limits_.end();
    if (has_limit && !is_known && states[node].limit != 0)
      limits_.emplace_back(node, states[node].limit);
  }
  std::ranges::fill(states, RecordedState());
}

std::vector<RecordedEntry> SinceCut::changed_entries(const RecordedTick& tick) const {
  std::vector<RecordedEntry> changed(tick.whole->begin(), tick.whole->end());
  std::erase_if(changed, [&](const RecordedEntry& it) {
    const bool is_given =
        std::ranges::find(tick.given, it.entry, &RecordedEntry::entry) != tick.given.end();
    return !is_given && it.entry < entries_.size() && entries_[it.entry] == it;
  });
  return changed;
}

void SinceCut::withdraw_limits(std::vector<RecordedState>& states) const {
  for (const auto& [node, limit] : limits_) states[node].limit = 0;
}

void SinceCut::restore_limits(std::vector<RecordedState>& states) {
  std::erase_if(limits_, [&](const auto& it) {
    return states[it.first].ticked || states[it.first].limit != 0;
  });
  for (const auto& [node, limit] : limits_) states[node].limit = limit;
}

void SinceCut::complete(RecordedTick& tick) {
  changed_.assign(tick.changed.begin(), tick.changed.end());
  changed_.insert(changed_.end(), forgotten_.begin(), forgotten_.end());
  forgotten_.clear();
  with_the_others(tick.reasons, reasoned_, reasons_);
  with_the_others(tick.heard, heard_from_, heard_);
  tick.changed = changed_;
  tick.reasons = reasons_;
  tick.heard = heard_;
  set_.assign(tick.set.begin(), tick.set.end());
  std::erase_if(set_, [&](std::uint32_t entry) {
    return std::ranges::find(tick.entries, entry, &RecordedEntry::entry) == tick.entries.end();
  });
  tick.set = set_;
}

}  // namespace lockstep::host
