// Finds standstills: synchronized nodes whose least progress has not risen above its best so far
// for longer than a limit, while somebody is held. This also finds a child that moves without
// getting anywhere: one that starts again for ever, or one that loses while it is held what it
// gains while it is ticked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/core/clock.h"
#include "judge/measure/synchronized_ticks.h"
#include "judge/measure/wait_chain.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

// A circle of nodes that wait for each other, or a chain of them that ends at what does not come.
struct Standstill {
  WaitChain chain;
  Nanoseconds since{0};
  Nanoseconds time{0};   // now
  double best = 0;       // that the least progress of the head was at in this activation
  std::size_t head = 0;  // of the links: who is to blame, if that stands too; else the first
  bool is_old = true;    // who is to blame, or each of a circle, stands for longer than the limit

  bool is_circle() const { return chain.obstacle == Obstacle::Circle; }
  const WaitLink& link() const { return chain.links[head]; }
};

// One node. A standstill ends with a new best, or when all children are at 1, where perpetual
// actions cannot rise. Time in which the node itself gets no ticks does not count.
class StallDetector {
 public:
  // No allocation.
  void after_tick(const SynchronizedTick& tick, bool holds_somebody);

  // Somebody is held, and has been, or was before, without a new best since then.
  bool stands() const { return stands_; }
  Nanoseconds since() const { return since_; }
  double best() const { return best_; }
  std::uint64_t number() const { return number_; }  // of the standstill, from 1

 private:
  bool runs_ = false;
  bool has_waited_ = false;  // somebody, since the best
  bool stands_ = false;
  double best_ = 0;
  std::uint64_t number_ = 0;
  Nanoseconds since_{0}, last_{0};
};

// All synchronized nodes of a tree.
class StandingNodes {
 public:
  struct Standing {
    SynchronizedTicks ticks;
    StallDetector detector = {};
    Nanoseconds next_look{0};  // not before
    // Numbers of standstills: of the last one that was reported, that was reported as a circle, and
    // that has to wait for a moment.
    std::uint64_t told = 0, told_as_circle = 0, put_off = 0;

    NodeIndex node() const { return ticks.node(); }
    bool is_over(Nanoseconds limit, Nanoseconds now) const {
      return detector.stands() && now - detector.since() > limit;
    }
  };
  // The shape must outlive this.
  StandingNodes(const Shape& shape, Nanoseconds limit);

  void after_tick(const Moment& moment);

  Nanoseconds limit() const { return limit_; }
  std::span<Standing> all() { return nodes_; }
  Standing* find(NodeIndex node);  // null: a pool
  // Describes a node that stands.
  Standstill standstill(const Moment& moment, const Standing& at, Nanoseconds now);
  // Members of pools alone that wait for each other for longer than the limit. Each circle once.
  std::optional<Standstill> circle_of_pools(const Moment& moment, Nanoseconds now);

 private:
  // A member of a pool that waits.
  struct Waiting {
    NodeIndex pool, user;
    bool waits = false, is_told = false;
    Nanoseconds since{0}, next_look{0};
  };
  bool is_over(const Waiting& it, Nanoseconds now) const {
    return it.waits && !it.is_told && now - it.since > limit_ && now >= it.next_look;
  }
  std::optional<Standstill> circle_at(const Moment& moment, Waiting& at, Nanoseconds now);
  void describe_circle(Standstill& circle);
  void describe_chain(Standstill& found, const Standing& at);

  const Shape& shape_;
  Nanoseconds limit_;
  std::vector<Standing> nodes_;
  std::vector<Waiting> users_;
};

// Reports each standstill once: of several nodes that stand for the same reason, the first one. One
// that becomes a circle later is reported again.
class StallWatch {
 public:
  using Report = std::function<void(const Standstill&)>;
  // Likewise.
  StallWatch(const Shape& shape, Nanoseconds limit, Report report);

  void after_tick(const Moment& moment);

 private:
  using Standing = StandingNodes::Standing;
  void look(const Moment& moment, Standing& at);

  StandingNodes nodes_;
  Report report_;
};

}  // namespace lockstep::host
