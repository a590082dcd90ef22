#include "engine/leaf_watch.h"

#include <algorithm>
#include <utility>

#include "engine/tree.h"

namespace lockstep::host {

LeafWatch::LeafWatch(LeafWatchOptions options) : options_(std::move(options)) {}

// A mode is changed most often when a leaf is used for the first time, so the first tick looks
// after each call.
void LeafWatch::begin_run(const Tree& tree, std::span<LeafSlot> leaves, ForkGuard::Byte* byte) {
  if (is_timed() && tree_ == nullptr) {
    ticks_.emplace(tree.leaves.size());
    over_.resize(tree.leaves.size());
  }
  tree_ = &tree;
  leaves_ = leaves;
  if (options_.alarm != nullptr) options_.alarm->attach(byte);
  mode_ = FloatMode::current();
  looks_left_ = 1;
  slowest_ = {};
}

void LeafWatch::end_run() {
  if (options_.alarm != nullptr) options_.alarm->attach(nullptr);
}

void LeafWatch::begin_tick() {
  if (!is_timed()) return;
  if (options_.alarm == nullptr) {
    if (options_.clock == nullptr) cycles_.adjust();
    budget_ = count_of(*options_.budget);
  } else if (!is_open_) {
    open_tick();
  }
  slowest_ = {};
  slowest_took_ = 0;
  inner_ = 0;
  set_usual();
}

void LeafWatch::open_tick() {
  is_open_ = true;
  is_explained_ = false;
  choose_what_is_timed();
  CallMark& mark = CallMark::this_thread();
  mark.carried = Nanoseconds(0);
  first_serial_ = mark.serial();
  if (options_.clock == nullptr) {
    const CycleClock::Reading begun = cycles_.adjust();
    opened_at_ = begun.time;
    opened_ = begun.count;
  } else {
    opened_at_ = options_.clock->now();
    opened_ = opened_at_.count();
  }
  budget_ = count_of(*options_.budget);
  options_.alarm->begin_tick(opened_at_);
}

void LeafWatch::choose_what_is_timed() {
  random_ ^= random_ << 13, random_ ^= random_ >> 7, random_ ^= random_ << 17;  // xorshift64
  const bool is_first = ++opened_ticks_ <= kFirstTicks;
  const bool is_sample = is_first || random_ % kSampled == 0;
  times_ = is_first ? 1 : is_sample ? kSampled : 0;
  is_timed_whole_ = times_each_ = is_sample || searches_left_ != 0;
  if (searches_left_ != 0) --searches_left_;
}

// A call that is over the budget is known, unless the alarm rang too late, or not at all.
void LeafWatch::close_tick() {
  const bool is_long = read() - opened_ > budget_;
  const auto rang = options_.alarm->rang();
  options_.alarm->end_tick();
  is_open_ = false;
  times_each_ = true;
  const bool is_late = !rang || *rang - opened_at_ > *options_.budget;
  if (is_long && !is_explained_ && !is_timed_whole_ && is_late) searches_left_ = kSearched;
}

void LeafWatch::time_each() {
  times_each_ = true;
  last_end_ = read();
}

void LeafWatch::note_if_rung(std::uint32_t place, PluginFunction function, CallMark& mark) {
  if (!is_open_ || times_each_ || !is_rung()) return;
  note_rung(place, function, 0, mark);
}

// The call began at some time between the begin of the tick and the alarm.
void LeafWatch::note_rung(std::uint32_t place, PluginFunction function, std::int64_t inner,
                          CallMark& mark) {
  time_each();
  const Nanoseconds carried = std::exchange(mark.carried, Nanoseconds(0));
  const std::int64_t most = last_end_ - opened_ - inner - count_of(carried);
  std::int64_t least = most;
  if (mark.serial() != first_serial_ + 1) {
    const auto rang = options_.alarm->rang().value_or(opened_at_);
    least -= count_of(std::max(rang - opened_at_, Nanoseconds(0)));
  }
  if (most > budget_) least = std::max(least, budget_);
  note_unusual(place, function, least + (most - least + 1) / 2 + count_of(carried), carried);
}

void LeafWatch::end_tick() {
  if (is_open_) close_tick();
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

LeafWatch::Begun LeafWatch::begin(CallMark& mark, bool is_timed) {
  if (!this->is_timed()) return {};
  if (!times_each_) time_each_if_rung();
  Begun begun{.inner = std::exchange(inner_, 0), .is_timed = times_each_ || is_timed};
  if (!begun.is_timed) return begun;
  begun.start = read();
  begun.carried = std::exchange(mark.carried, Nanoseconds(0));
  return begun;
}

NodeIndex LeafWatch::leaf_at(std::uint32_t place) const {
  return tree_->leaves[place].node;
}

void LeafWatch::end(const Begun& begun, std::uint32_t place, PluginFunction function,
                    CallMark& mark) {
  if (FloatMode::current() != mode_) [[unlikely]]
    restore_mode(leaf_at(place), function);
  if (!is_timed()) return;
  if (!begun.is_timed) {
    const std::int64_t inner = inner_;
    if (times_each_ || is_rung()) note_rung(place, function, inner, mark);
    inner_ = begun.inner + inner;
    return;
  }
  last_end_ = read();
  const std::int64_t whole = last_end_ - begun.start;
  const std::int64_t own = whole - std::exchange(inner_, begun.inner + whole);
  note_unusual(place, function, own, std::exchange(mark.carried, begun.carried));
  if (!times_each_) time_each_if_rung();  // in this call, of which all is known
}

void LeafWatch::note_unusual(std::uint32_t place, PluginFunction function, std::int64_t took,
                             Nanoseconds carried) {
  if (carried != Nanoseconds(0)) took -= count_of(carried);
  took = std::max<std::int64_t>(took, 0);
  if (slowest_.function == PluginFunction::None || took > slowest_took_) {
    slowest_ = {leaf_at(place), function, Nanoseconds(0)};
    slowest_took_ = took;
    set_usual();
  }
  if (budget_ == 0) return;  // before the first tick, which waits
  if (took > budget_) {
    note_over_budget(place, function, took);
  } else if (carried > *options_.budget && may_tell() && options_.on_carried) {
    options_.on_carried(leaf_at(place), carried);
  }
  if (function != PluginFunction::Tick) return;
  // Each tick of a leaf that was over the budget is timed.
  ticks_->record(place, static_cast<std::uint64_t>(took), over_[place].calls != 0 ? 1 : times_);
}

void LeafWatch::set_usual() {
  usual_ = slowest_.function == PluginFunction::None
               ? 0
               : std::min(static_cast<std::uint64_t>(std::min(slowest_took_, budget_)),
                          Histograms::kLargest);
}

void LeafWatch::note_over_budget(std::uint32_t place, PluginFunction function, std::int64_t took) {
  OverBudget& over = over_[place];
  if (over.calls++ == 0) over.is_sampled = opened_ticks_ > kFirstTicks;
  over.max = std::max(over.max, took);
  is_explained_ = true;
  if (options_.alarm != nullptr) leaves_[place].mark(LeafSlot::kTimed, true);
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
    list.push_back({.leaf = leaf_at(place),
                    .is_sampled = over.is_sampled,
                    .ticks = ticks_->count(place),
                    .over_budget = over.calls,
                    .p50 = quantile(0.5),
                    .p99 = quantile(0.99),
                    .max = time_of(over.max)});
  }
  std::ranges::stable_sort(list, std::greater{}, &Timing::max);
  return list;
}

}  // namespace lockstep::host
