// The clocks of robots of a team, from what each recording has of the others. A recording has the
// tick in which its robot knew a word of another one, and the recording of that robot has the tick
// after which it was sent. What is known was sent before, so each word is a bound of the difference
// of two clocks, whatever the network did: those of the two directions enclose it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "record/recording.h"

namespace lockstep::host {

// That a tree is in a team: as which member, and the nodes that stand for others; none where it
// only shares a pool.
struct Membership {
  std::string team, self;
  std::vector<NodeIndex> others;
};
std::vector<Membership> memberships_of(const Shape& shape);

// What one recording has about the clock of a process, in its own seconds. A run that was cut and
// continued has a process for each part, and the pauses between them are not in its seconds.
struct TeamWords {
  struct Tick {
    std::uint64_t tick = 0;  // of this process, from 0
    double time = 0;
  };
  struct Word {
    std::uint32_t run = 0;
    std::uint64_t word = 0;
    double time = 0;  // of the tick that knew it first
  };
  std::uint64_t run = 0;         // RecordingHeader::run; 0: it has none
  std::uint64_t first_tick = 0;  // of the run, in this process
  bool is_real = false;          // of the wall clock
  std::vector<Tick> ticks = {};
  std::vector<Word> heard = {};

  void add(const RecordedTick& tick);
  // Not after this it sent the word. None: it did before the recording begins.
  std::optional<double> sent(std::uint64_t word) const;
};

// Where the time of a robot is on that of another one: `began` + (1 + `drift`) x its seconds.
struct ClockFit {
  double began = 0;
  double uncertainty = 0;  // of `began`, in both directions
  double drift = 0;        // 0 where the words do not contradict it
};

// What two recordings know of each other. `began` is in [least, most]; infinite: no word came in
// that direction. least > most: they contradict each other, whatever the drift is.
struct ClockBounds {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  double drift = 0;

  bool is_closed() const {
    return least > -std::numeric_limits<double>::infinity() &&
           most < std::numeric_limits<double>::infinity();
  }
  ClockFit fit() const { return {(least + most) / 2, (most - least) / 2, drift}; }
};

// Of `robot`, on the time that `other` is on by `others`.
ClockBounds clock_bounds(const TeamWords& other, const ClockFit& others, const TeamWords& robot);

}  // namespace lockstep::host
