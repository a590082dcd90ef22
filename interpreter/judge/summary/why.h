// Why a node has the status that it has: the chain of nodes that decided, or wait, and the reason
// of each. A leaf gives its own (trace/reason.h). Those of the engine's nodes follow from what they
// look at: a condition has its script and the values of its entries, a Timeout its time, a Retry
// its attempts, and a user of a pool the owners of what it waits for.
//
// Example: Main failed, because grasp failed after 3 attempts, because see failed: "no object at
// (0.3, 1.2)".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/core/resource_set.h"
#include "base/core/value.h"
#include "judge/measure/decision.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

// What a node has tried: again, or before the child that decided.
struct Attempt {
  std::uint64_t tick = 0;
  NodeIndex node = 0;  // that decided
  std::string reason = {};
  std::uint64_t times = 1;  // in a row in this tick, without a reason
};

struct WhyLink {
  DecidingNode decided;
  std::size_t depth = 0;  // below the first link
  bool is_held = false;
  bool stood_still = false;  // it failed because of --stall-fail
  std::string reason = {};
  std::uint64_t failed_attempts = 0;  // of a node that tries again, in this activation
  // Where they are counted from, if the activation may be older than what is known of the run.
  std::optional<std::uint64_t> attempts_since = {};
  std::vector<Attempt> attempts = {};  // the last of these
  std::vector<Attempt> others = {};    // of the other children that have the same result
};

// Follows a run, whatever its Moments come from, and keeps what reasons need of the past.
class WhyWatch {
 public:
  static constexpr std::size_t kAttempts = 8;  // kept of each node that tries again

  // `shape` must outlive this.
  explicit WhyWatch(const Shape& shape);

  // What the Moments of a run must have.
  AskedOfRun asked() const;

  // After each tick, in their order.
  void after_tick(const Moment& moment);

  // About the last of these Moments: the node, and below it, in pre-order, of a node that has
  // completed the child that decided, of one that runs those that run.
  std::vector<WhyLink> why(const Moment& moment, NodeIndex node = 0) const;

 private:
  // An entry that conditions read.
  struct Watched {
    std::uint32_t entry = 0;  // in Shape::entries
    std::uint32_t writes = 0;
    std::optional<std::uint64_t> tick = {};  // of the last change; none: the value of the start
    std::vector<NodeIndex> writers = {};     // that may write it, and were ticked then
    Value value = {};                        // of a run that goes on
  };
  struct Tries {
    NodeIndex node = 0, child = 0;
    bool runs = false;
    std::uint64_t failed = 0;  // of this activation
    std::vector<Attempt> last = {};
    std::optional<std::uint64_t> since = {};
  };
  struct Timed {
    NodeIndex node = 0;
    bool runs = false;
    std::optional<Nanoseconds> began = {};  // none: before what is known of the run
    // What something in it waits for, as long as it runs.
    NodeIndex waiting = 0;  // 0: nothing says so
    std::string reason = {};
    double limit = 0;  // of a user of a pool
  };
  // Of a pool.
  struct User {
    NodeIndex node = 0;
    ResourceSet owned = 0;
    std::uint64_t since = 0;  // the tick in which it got the last of these
  };

  void follow_stalls(const Moment& moment);
  bool stood_still(const Moment& moment, NodeIndex node) const;
  std::string reason(const Moment& moment, NodeIndex node) const;
  std::string condition_text(const Moment& moment, NodeIndex node) const;
  std::string value_text(const Moment& moment, const std::string& key) const;
  std::string time_text(const Moment& moment, NodeIndex node) const;
  std::vector<Attempt> others(const Moment& moment, const DecidingNode& node) const;
  std::vector<User> owners(const Moment& moment, NodeIndex user) const;
  std::string owner_text(const Moment& moment, NodeIndex user) const;
  std::string words_of_owners(const Moment& moment, NodeIndex user) const;
  void follow_attempts(const Moment& moment, bool is_later_part);
  // `part` is the state within the tick.
  void follow_attempt(const Moment& moment, const Moment& part, Tries& tries, std::uint64_t times,
                      bool is_later_part) const;
  void note_attempt(const Moment& moment, const Moment& part, Tries& tries,
                    std::uint64_t times) const;
  void follow_time(const Moment& moment, Timed& timed, bool is_later_part) const;

  const Shape& shape_;
  std::vector<Watched> watched_;
  std::vector<Tries> tries_;
  std::vector<Timed> timed_;
  std::vector<User> users_;
  std::vector<NodeIndex> stood_still_;  // and have not been ticked since
  // A part of a tick as a Moment of its own.
  std::vector<NodeState> column_;
  std::vector<Activity> activity_;
  std::vector<std::uint32_t> reached_;
  bool has_begun_ = false;
};

}  // namespace lockstep::host
