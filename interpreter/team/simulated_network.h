// A network between runs of one process, on a clock that they share: for `lockstep team` and for
// tests. Everything comes from the seed, so that the same run comes again.
//
// A run that begins hears the last word of each robot that runs, and nothing of one that has ended.
//
// Each run is in a thread of its own, and one of them goes on at a time: the one whose next tick is
// the earliest, of several the first. TurnClock gives them their turns.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/core/random.h"
#include "team/transport.h"

namespace lockstep::host {

// The time of several runs.
class Turns {
 public:
  explicit Turns(std::size_t runs);

  // In the thread of a run, before anything else of it: waits for its first turn, at `begin`.
  void enter(std::size_t run, Nanoseconds begin);
  // The end of its turn; the next one is at that time.
  void wait(std::size_t run, Nanoseconds until);
  void leave(std::size_t run);
  Nanoseconds now(std::size_t run);

 private:
  bool has_turn(std::size_t run) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  struct Turn {
    Nanoseconds next{0}, now{0};
    bool is_over = false;
  };
  std::vector<Turn> turns_;
};

class TurnClock final : public Clock {
 public:
  TurnClock(Turns& turns, std::size_t run) : turns_(turns), run_(run) {}
  Nanoseconds now() override { return turns_.now(run_); }
  void sleep_until(Nanoseconds deadline) override { turns_.wait(run_, deadline); }
  bool is_real() const override { return false; }

 private:
  Turns& turns_;
  const std::size_t run_;
};

struct NetworkOptions {
  Nanoseconds latency{0};  // of each word
  Nanoseconds jitter{0};   // and up to so much more
  double loss = 0;         // the fraction of words that are lost, in [0, 1], and sent again
  struct Cut {
    Nanoseconds from{0}, until{0};
  };
  std::vector<Cut> cuts = {};  // nothing is sent then; it is sent later
  std::uint64_t seed = 0;
};

class SimulatedNetwork {
 public:
  explicit SimulatedNetwork(const NetworkOptions& options);
  ~SimulatedNetwork();

  // Before any of them runs. `clock` must outlive this.
  TeamTransport& join(const std::vector<TeamDeclaration>& teams, Clock& clock);

  // Its process is killed. A run that ends in order stays: its last word may be on its way.
  void leave(const TeamTransport& link);

  // The largest difference in progress of two members that did one round of a team at one time.
  double largest_spread() const { return largest_spread_; }

 private:
  class Link;
  void say(const Link& from, std::uint32_t team, const TeamWord& word);
  // Of what is sent then; nothing: it is lost.
  std::optional<Nanoseconds> arrival(Nanoseconds sent);
  void measure(const TeamDeclaration& team);

  const NetworkOptions options_;
  RandomStream random_;
  std::vector<std::unique_ptr<Link>> links_;
  double largest_spread_ = 0;
};

}  // namespace lockstep::host
