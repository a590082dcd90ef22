#include "plugin/contract/leaf_watch.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "core/histogram.h"
#include "core/plugin_exception.h"
#include "lockstep/leaf.h"
#include "plugin/contract/carried_time.h"
#include "plugin/contract/float_mode.h"
#include "system/cycle_clock.h"

namespace lockstep::host {
namespace {

// What all leaves of a watch share.
struct Watch {
  LeafWatchOptions options;
  CycleClock cycles;
  FloatMode mode;
  LeafWatch::Slowest slowest;
  std::optional<Nanoseconds> told;  // when on_slow was
  Nanoseconds inner{0};             // calls within the current one, of a control node's children

  explicit Watch(LeafWatchOptions given) : options(std::move(given)) {}

  Nanoseconds now() const { return options.clock == nullptr ? cycles.now() : options.clock->now(); }
};

// What stands in a slot in the place of a leaf.
struct WatchedLeaf {
  Watch* watch;
  const lockstep_leaf_type* type;
  void* self;
  const CallSite* site;
  NodeIndex node = 0;
  bool mode_told = false;
  std::uint64_t over_budget = 0;
  Nanoseconds max{0};
  std::optional<Histogram> ticks;  // when calls are timed
};

// Marks a call and restores the mode after it, also when an exception ends the call.
class WatchedCall {
 public:
  WatchedCall(WatchedLeaf& leaf, PluginFunction function)
      : leaf_(leaf), mark_(CallMark::this_thread()), around_(mark_.current()), function_(function) {
    mark_.enter(*leaf.site, function);
  }

  ~WatchedCall() {
    mark_.leave(around_);
    if (FloatMode::current() != leaf_.watch->mode) [[unlikely]]
      restore_mode();
  }

  WatchedCall(const WatchedCall&) = delete;
  WatchedCall& operator=(const WatchedCall&) = delete;

 private:
  // Out of line, so that the rest of each call is inline.
  [[gnu::cold, gnu::noinline]] void restore_mode() {
    const Watch& watch = *leaf_.watch;
    watch.mode.restore();
    if (std::exchange(leaf_.mode_told, true) || !watch.options.on_float_mode) return;
    watch.options.on_float_mode(leaf_.node, function_);
  }

  WatchedLeaf& leaf_;
  CallMark& mark_;
  const CallMark::Look around_;
  const PluginFunction function_;
};

// The time of a call, also of one that an exception ends.
class TimedCall {
 public:
  TimedCall(WatchedLeaf& leaf, PluginFunction function)
      : leaf_(leaf),
        function_(function),
        outer_(std::exchange(leaf.watch->inner, Nanoseconds(0))),
        outer_carried_(std::exchange(t_carried, Nanoseconds(0))),
        start_(leaf.watch->now()) {}
  ~TimedCall() { note_time(*leaf_.watch, leaf_.watch->now()); }

  TimedCall(const TimedCall&) = delete;
  TimedCall& operator=(const TimedCall&) = delete;

 private:
  void note_time(Watch& watch, Nanoseconds end) {
    const Nanoseconds whole = end - start_;
    const Nanoseconds carried = std::exchange(t_carried, outer_carried_);
    const Nanoseconds took = std::max(whole - watch.inner - carried, Nanoseconds(0));
    watch.inner = outer_ + whole;
    if (function_ == PluginFunction::Tick) leaf_.ticks->record(took);
    leaf_.max = std::max(leaf_.max, took);
    if (watch.slowest.function == PluginFunction::None || took > watch.slowest.took) {
      watch.slowest = {leaf_.node, function_, took};
    }
    if (took > *watch.options.budget) [[unlikely]] {
      ++leaf_.over_budget;
      if (may_tell(watch, end) && watch.options.on_slow) {
        watch.options.on_slow(leaf_.node, function_, took);
      }
    } else if (carried > *watch.options.budget) [[unlikely]] {
      if (may_tell(watch, end) && watch.options.on_carried) {
        watch.options.on_carried(leaf_.node, carried);
      }
    }
  }

  static bool may_tell(Watch& watch, Nanoseconds end) {
    if (watch.told && end - *watch.told < std::chrono::seconds(1)) return false;
    watch.told = end;
    return true;
  }

  WatchedLeaf& leaf_;
  const PluginFunction function_;
  const Nanoseconds outer_, outer_carried_;  // of the call around this one
  const Nanoseconds start_;
};

// A function of the leaf type that stands in the slot: calls the same one of the leaf.
template <auto kMember, PluginFunction kFunction>
auto forward(void* self) {
  auto& leaf = *static_cast<WatchedLeaf*>(self);
  const WatchedCall call(leaf, kFunction);
  return rethrowing([&] { return (leaf.type->*kMember)(leaf.self); });
}

template <auto kMember, PluginFunction kFunction>
auto forward_timed(void* self) {
  const TimedCall call(*static_cast<WatchedLeaf*>(self), kFunction);
  return forward<kMember, kFunction>(self);
}

const void* forward_get_extension(void* self, const char* id) {
  const auto& leaf = *static_cast<const WatchedLeaf*>(self);
  return leaf.type->get_extension(leaf.self, id);
}

// What the leaf does not have, the watched one has not either.
template <auto kMember, PluginFunction kFunction>
void put_in_front(lockstep_leaf_type& type, bool is_timed) {
  if (type.*kMember == nullptr) return;
  type.*kMember = is_timed ? forward_timed<kMember, kFunction> : forward<kMember, kFunction>;
}

lockstep_leaf_type watched(lockstep_leaf_type type, bool is_timed) {
  using Type = lockstep_leaf_type;
  type.create = nullptr;  // only LeafSet calls it, and destroy
  type.destroy = nullptr;
  put_in_front<&Type::start, PluginFunction::Start>(type, is_timed);
  put_in_front<&Type::start_unreset, PluginFunction::StartUnreset>(type, is_timed);
  put_in_front<&Type::tick, PluginFunction::Tick>(type, is_timed);
  put_in_front<&Type::halt, PluginFunction::Halt>(type, is_timed);
  put_in_front<&Type::pause, PluginFunction::Pause>(type, is_timed);
  put_in_front<&Type::resume, PluginFunction::Resume>(type, is_timed);
  put_in_front<&Type::progress, PluginFunction::Progress>(type, is_timed);
  if (type.get_extension != nullptr) type.get_extension = forward_get_extension;
  return type;
}

}  // namespace

struct LeafWatch::Implementation {
  explicit Implementation(LeafWatchOptions options) : watch(std::move(options)) {}

  void know_leaves(const Tree& tree, std::span<LeafSlot> slots,
                   std::span<const CallSite* const> sites);

  Watch watch;
  std::map<const lockstep_leaf_type*, lockstep_leaf_type> types;  // by the leaf's own
  std::vector<WatchedLeaf> leaves;                                // one for each slot
};

void LeafWatch::Implementation::know_leaves(const Tree& tree, std::span<LeafSlot> slots,
                                            std::span<const CallSite* const> sites) {
  leaves.reserve(slots.size());
  for (std::size_t index = 0; index < slots.size(); ++index) {
    const lockstep_leaf_type* const type = slots[index].type;
    types.try_emplace(type, watched(*type, watch.options.budget.has_value()));
    std::optional<Histogram> ticks;
    if (watch.options.budget) ticks.emplace(Histogram::kCoarse);
    leaves.push_back({.watch = &watch,
                      .type = type,
                      .self = nullptr,
                      .site = sites[index],
                      .node = tree.leaves[index].node,
                      .ticks = std::move(ticks)});
  }
}

LeafWatch::LeafWatch(LeafWatchOptions options)
    : it_(std::make_unique<Implementation>(std::move(options))) {}

LeafWatch::~LeafWatch() = default;

void LeafWatch::insert(const Tree& tree, std::span<LeafSlot> slots,
                       std::span<const CallSite* const> sites) {
  if (it_->leaves.empty()) it_->know_leaves(tree, slots, sites);
  assert(it_->leaves.size() == slots.size());
  it_->watch.mode = FloatMode::current();
  it_->watch.slowest = {};
  CallMark::this_thread().set_tick(CallMark::kNoTick);
  for (std::size_t index = 0; index < slots.size(); ++index) {
    it_->leaves[index].self = slots[index].self;
    slots[index].type = &it_->types.at(slots[index].type);
    slots[index].self = &it_->leaves[index];
  }
}

void LeafWatch::remove(std::span<LeafSlot> slots) {
  for (std::size_t index = 0; index < std::min(slots.size(), it_->leaves.size()); ++index) {
    const WatchedLeaf& leaf = it_->leaves[index];
    if (slots[index].self != &leaf) continue;
    slots[index].type = leaf.type;
    slots[index].self = leaf.self;
  }
}

void LeafWatch::begin_tick(std::uint64_t tick) {
  CallMark::this_thread().set_tick(tick);
  it_->watch.slowest = {};
  if (it_->watch.options.budget) it_->watch.cycles.adjust();
}

LeafWatch::Slowest LeafWatch::slowest() const {
  return it_->watch.slowest;
}

std::vector<LeafWatch::Timing> LeafWatch::over_budget() const {
  std::vector<Timing> list;
  for (const WatchedLeaf& leaf : it_->leaves) {
    if (leaf.over_budget == 0) continue;
    list.push_back({leaf.node, leaf.ticks->count(), leaf.over_budget, leaf.ticks->quantile(0.5),
                    leaf.ticks->quantile(0.99), leaf.max});
  }
  std::ranges::stable_sort(list, std::greater{}, &Timing::max);
  return list;
}

}  // namespace lockstep::host
