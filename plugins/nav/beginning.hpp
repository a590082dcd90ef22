// When a node that keeps something from activation to activation begins again.
#pragma once

#include <lockstep/leaf.hpp>

#include <cstdint>
#include <optional>
#include <utility>

namespace nav {

// A node that continues from its last tick begins again when it was not ticked in the tick before:
// its parent has done something else meanwhile.
class LastTick {
 public:
  // Notes a tick. Whether the node was not ticked in the tick before. A run that is late leaves out
  // ticks, and their numbers with them.
  bool is_after_gap(std::uint64_t number) {
    const bool is_gap = !last_ || number > *last_ + 1;
    last_ = number;
    return is_gap;
  }

 private:
  std::optional<std::uint64_t> last_;
};

// In a tree for BehaviorTree.CPP a parent resets its children, or it does not: a RateController in
// a PipelineSequence continues its period after a success, one in a Sequence begins.
inline bool is_for_btcpp(std::string_view language) {
  return language == "BTCPP_format";
}

// A decorator that begins again when its parent has reset it, where parents do; in lockstep's own
// language after a gap in its ticks. A halt resets it in both.
template <class PortsOfNode>
class Beginning : public lockstep::Decorator<PortsOfNode> {
 public:
  using Status = lockstep::Status;
  void start() final { is_reset_ |= parents_reset_; }
  void start_unreset() final {}
  void halt() final { is_reset_ = true; }

 protected:
  // Once in each tick.
  bool begins() {
    const bool is_gap = last_tick_.is_after_gap(this->tick_number());
    return std::exchange(is_reset_, false) || (is_gap && !parents_reset_);
  }
  // In lockstep's own language it begins again after this tick.
  void reset() { is_reset_ = !parents_reset_; }
  bool child_runs() const { return this->child_status() == Status::Running; }

 private:
  const bool parents_reset_ = is_for_btcpp(this->language());
  LastTick last_tick_;
  bool is_reset_ = true;
};

inline constexpr double kRounding = 1e-9;  // of a sum of ticks

}  // namespace nav
