// Action and Condition, from which leaves derive. Included by lockstep/leaf.hpp.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "port.hpp"
#include "run_context.hpp"

namespace lockstep {
inline namespace sdk1 {

namespace detail {

// Where the leaf under construction finds its caller, so that authors need not pass it on.
inline thread_local const Caller* creating = nullptr;

struct LeafAccess;
struct ElementAccess;

}  // namespace detail

// How the process of a run was cut, for the process that continues: lockstep/leaf.h.
using Cut = lockstep_cut;

// What an action does after a cut.
enum class AfterCut : lockstep_after_cut {
  StartsAgain = LOCKSTEP_STARTS_AGAIN,       // with start(), before its next tick
  Continues = LOCKSTEP_CONTINUES,            // it runs as before
  CannotContinue = LOCKSTEP_CANNOT_CONTINUE  // it fails, without a tick
};

// Common to actions and conditions: the host's services, and what the leaves of a run share.
class Leaf : protected Services {
 public:
  using Status = sdk1::Status;
  // Redeclare this as true in a leaf that works between ticks: in threads, with devices. On the
  // virtual clock, where ticks do not wait for it, lockstep warns of it.
  static constexpr bool kRealTime = false;
  // True in a class that calls wake().
  static constexpr bool kWakes = false;
  // True in a ThreadedAction that obeys token.pace().
  static constexpr bool kPaces = false;
  virtual ~Leaf() = default;

 protected:
  Leaf() : Services(creator()) {}

  // The run context of this run, declared to the plugin with lockstep::run_context<Context>().
  template <class Context>
  Context& context() const {
    return detail::ContextHolder<Context>::from(caller_.run_context).value;
  }

  // A result with its reason: a text of any kind. Of fmt a format and its arguments, too, where the
  // plugin includes fmt before this header.
  template <class Result, class Reason>
  Result because(Result result, const Reason& reason) const {
    if constexpr (std::is_convertible_v<const Reason&, const char*>) {
      say(reason);
    } else {
      say(std::string(reason).c_str());
    }
    return result;
  }

 private:
  friend struct detail::LeafAccess;
  friend struct detail::ElementAccess;

  static const detail::Caller& creator() {
    if (!detail::creating) throw std::logic_error("a leaf can only be created by its host");
    return *detail::creating;
  }
};

// The functions of an action. Only those that are overridden exist for the host. Each runs in the
// thread that ticks the tree and must return quickly. To fail as an action, return Failure, or
// fail("no object at the door"); to report that the leaf is broken, throw: the run ends in order,
// with the message as its reason.
class ActionFunctions : public Leaf {
 public:
  // Once per tick, from start until it returns Success, Failure or Skipped.
  virtual Status tick() = 0;
  // The first tick of an activation is about to come. The object may have been active before.
  virtual void start() {}
  // In place of start(), when the node has completed and its parent, which keeps its result, ticks
  // it again. An action without an override is not ticked then.
  virtual void start_unreset() {}
  // Stop now: the activation ends without a result. May come while paused.
  virtual void halt() {}
  // Hold still, keep the position: no ticks for a while.
  virtual void pause() {}
  // Ticks come again.
  virtual void resume() {}
  // How much of the activation is done, in [0, 1]; called only while running, also while paused. It
  // may fall.
  virtual double progress() const { return 0; }
  // How fast to be from now on, in (0, 1]; 1 is as fast as the action is by itself. Called where a
  // node with pace="true" slows the action, when that changes: after start() or resume(), before
  // tick(). Each activation begins with 1. Undo at its end, and in halt(), what a device was told.
  // Returns what the action takes up: `factor`, its least speed, or 1 where it cannot be slower.
  virtual double set_pace(double /*factor*/) { return 1; }
  // For an action that continues after its process was cut: `run --checkpoint FILE --resume`.
  // Derive from Kept<State> in place of these where plain members are enough. After each tick in
  // which it runs or is held: writes what another object needs to go on from here, at most `room`
  // bytes (64 KiB), and returns how many; 0: nothing. Only copy.
  virtual std::size_t save(void* /*bytes*/, std::size_t /*room*/) const { return 0; }
  // In place of start(), on a new object, with the bytes of the last save().
  virtual AfterCut restore(std::string_view /*bytes*/, const Cut& /*cut*/) {
    return AfterCut::StartsAgain;
  }

 protected:
  static constexpr bool kKeepsProgress = false;  // see kept_progress

  // In tick: `return fail("no object at the door");` is Failure with its reason, and
  // `return wait("force 3 of 10 N");` is Running with what the action waits for. `log why`, the
  // summary of the run and the page show it.
  template <class Reason>
  Status fail(const Reason& reason) const {
    return because(Status::Failure, reason);
  }
  template <class Reason>
  Status wait(const Reason& reason) const {
    return because(Status::Running, reason);
  }
#ifdef FMT_VERSION
  template <class First, class... Rest>
  Status fail(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) const {
    return fail(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <class First, class... Rest>
  Status wait(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) const {
    return wait(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
#endif

 private:
  friend struct detail::LeafAccess;
  virtual void before_start() {}
  virtual void before_pace(double /*factor*/) {}
  // Where the host reads the progress without a call.
  virtual const double* kept_progress() const {
    return nullptr;
  }
  // Ends everything that must end before any part of a derived leaf is destroyed.
  virtual void before_destroy() {}
};

namespace detail {
struct KeptBase {};
struct KeptAccess;
}  // namespace detail

// What an action keeps over a cut of its process, as plain members:
//   struct Arm { double at = 0; int phase = 0; };
//   class Move : public lockstep::Action<MovePorts>, public lockstep::Kept<Arm> { … kept.at … };
// Each activation begins with a new State. After a cut, the action continues with the State of the
// last tick that was kept, if after_cut() agrees.
template <class State>
class Kept : public detail::KeptBase {
  static_assert(std::is_trivially_copyable_v<State>, "a State is kept as its bytes: no pointers");
  static_assert(sizeof(State) <= LOCKSTEP_MOST_KEPT, "at most 64 KiB are kept of a leaf");

 public:
  using KeptState = State;

 protected:
  ~Kept() = default;

  State kept{};
  // In place of start(), with `kept` as it was: looks whether the robot is still as it was, and
  // takes hold of it. With cut.held, resume() comes before the next tick: stay there until then.
  virtual AfterCut after_cut(const Cut& /*cut*/) { return AfterCut::Continues; }

 private:
  friend struct detail::KeptAccess;
};

template <class PortsOfLeaf = NoPorts>
class Action : public ActionFunctions, public PortsOfLeaf {
 public:
  using PortsType = PortsOfLeaf;

 protected:
  Action() { detail::PortsAccess::bind(*this, this->caller_); }
};

// An action that sets its progress where it changes, in place of a function that computes it:
// lockstep reads the number without a call. Each activation begins with 0.
template <class PortsOfLeaf = NoPorts>
class ProgressAction : public Action<PortsOfLeaf> {
 public:
  double progress() const override { return progress_; }

 protected:
  static constexpr bool kKeepsProgress = true;
  // Read once, when the leaf was made. False: lockstep calls progress(), which the leaf overrides.
  virtual bool keeps_progress() const { return true; }
  // In [0, 1], as progress() of an Action. In the thread that ticks the tree.
  void set_progress(double progress) { progress_ = progress; }

 private:
  friend struct detail::LeafAccess;
  void before_start() final { progress_ = 0; }
  const double* kept_progress() const final { return keeps_progress() ? &progress_ : nullptr; }

  double progress_ = 0;
};

// A question with an answer in the same tick.
class ConditionFunctions : public Leaf {
 public:
  // true is Success, false is Failure.
  virtual bool check() = 0;

 protected:
  // In check: `return fail("the door is closed");` is false with its reason.
  template <class Reason>
  bool fail(const Reason& reason) const {
    return because(false, reason);
  }
#ifdef FMT_VERSION
  template <class First, class... Rest>
  bool fail(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) const {
    return fail(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
#endif
};

template <class PortsOfLeaf = NoPorts>
class Condition : public ConditionFunctions, public PortsOfLeaf {
 public:
  using PortsType = PortsOfLeaf;

 protected:
  Condition() { detail::PortsAccess::bind(*this, this->caller_); }
};

}  // namespace sdk1
}  // namespace lockstep
