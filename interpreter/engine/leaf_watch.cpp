#include "engine/leaf_watch.h"

#include <algorithm>
#include <utility>

#include "engine/tree.h"

namespace lockstep::host {

LeafWatch::LeafWatch(LeafWatchOptions options) : options_(std::move(options)) {}

// A mode is changed most often when a leaf is used for the first time, so the first tick looks
// after each call.
void LeafWatch::begin_run(const Tree& tree) {
  if (is_timed() && tree_ == nullptr) {
    ticks_.emplace(tree.leaves.size());
    over_.resize(tree.leaves.size());
  }
  tree_ = &tree;
  mode_ = FloatMode::current();
  looks_left_ = 1;
  slowest_ = {};
}

void LeafWatch::begin_tick() {
  if (!is_timed()) return;
  slowest_ = {};
  slowest_took_ = 0;
  inner_ = 0;
  if (options_.clock == nullptr) cycles_.adjust();
  budget_ =
      options_.clock == nullptr ? cycles_.count_of(*options_.budget) : options_.budget->count();
  set_usual();
}

void LeafWatch::end_tick() {
  if (FloatMode::current() != mode_) [[unlikely]] {
    restore_mode(std::nullopt, PluginFunction::None);
    looks_left_ = std::exchange(next_looks_, std::min(next_looks_ * 2, 1u << 20)) + 1;
  }
  if (looks_left_ != 0 && !options_.looks_after_each_call) --looks_left_;
}

void LeafWatch::restore_mode(std::optional<NodeIndex> leaf, PluginFunction function) {
  mode_.restore();
  if (!leaf) {
    if (std::exchange(unknown_told_, true)) return;
  } else {
    next_looks_ = 1;
    if (std::ranges::find(mode_told_, *leaf) != mode_told_.end()) return;
    mode_told_.push_back(*leaf);
  }
  if (options_.on_float_mode) options_.on_float_mode(leaf, function);
}

LeafWatch::Begun LeafWatch::begin(CallMark& mark) {
  if (!is_timed()) return {};
  return {.start = read(),
          .inner = std::exchange(inner_, 0),
          .carried = std::exchange(mark.carried, Nanoseconds(0))};
}

NodeIndex LeafWatch::leaf_at(std::uint32_t place) const {
  return tree_->leaves[place].node;
}

void LeafWatch::end(const Begun& begun, std::uint32_t place, PluginFunction function,
                    CallMark& mark) {
  if (FloatMode::current() != mode_) [[unlikely]]
    restore_mode(leaf_at(place), function);
  if (!is_timed()) return;
  last_end_ = read();
  const std::int64_t whole = last_end_ - begun.start;
  const std::int64_t own = whole - std::exchange(inner_, begun.inner + whole);
  note_unusual(place, function, own, std::exchange(mark.carried, begun.carried));
}

void LeafWatch::note_unusual(std::uint32_t place, PluginFunction function, std::int64_t took,
                             Nanoseconds carried) {
  if (carried != Nanoseconds(0)) {
    took -= options_.clock == nullptr ? cycles_.count_of(carried) : carried.count();
  }
  took = std::max<std::int64_t>(took, 0);
  if (function == PluginFunction::Tick) ticks_->record(place, static_cast<std::uint64_t>(took));
  if (slowest_.function == PluginFunction::None || took > slowest_took_) {
    slowest_ = {leaf_at(place), function, Nanoseconds(0)};
    slowest_took_ = took;
    set_usual();
  }
  if (took > budget_) {
    note_over_budget(place, function, took);
  } else if (carried > *options_.budget && may_tell() && options_.on_carried) {
    options_.on_carried(leaf_at(place), carried);
  }
}

void LeafWatch::set_usual() {
  usual_ = slowest_.function == PluginFunction::None
               ? 0
               : std::min(static_cast<std::uint64_t>(std::min(slowest_took_, budget_)),
                          Histograms::kLargest);
}

void LeafWatch::note_over_budget(std::uint32_t place, PluginFunction function, std::int64_t took) {
  ++over_[place].calls;
  over_[place].max = std::max(over_[place].max, took);
  if (may_tell() && options_.on_slow) options_.on_slow(leaf_at(place), function, time_of(took));
}

bool LeafWatch::may_tell() {
  if (told_ && time_of(last_end_ - *told_) < std::chrono::seconds(1)) return false;
  told_ = last_end_;
  return true;
}

LeafWatch::Slowest LeafWatch::slowest() const {
  return {slowest_.leaf, slowest_.function, time_of(slowest_took_)};
}

std::vector<LeafWatch::Timing> LeafWatch::over_budget() const {
  std::vector<Timing> list;
  for (std::uint32_t place = 0; place < over_.size(); ++place) {
    const OverBudget& over = over_[place];
    if (over.calls == 0) continue;
    const auto quantile = [&](double fraction) {
      const auto count = static_cast<std::int64_t>(ticks_->quantile(place, fraction));
      return time_of(std::min(count, over.max));
    };
    list.push_back({leaf_at(place), ticks_->count(place), over.calls, quantile(0.5), quantile(0.99),
                    time_of(over.max)});
  }
  std::ranges::stable_sort(list, std::greater{}, &Timing::max);
  return list;
}

}  // namespace lockstep::host
