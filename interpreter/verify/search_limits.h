// A search ends at these limits. Here is also how it is made, and its progress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "base/core/clock.h"

namespace lockstep::host {

// What the questions of a verdict take for each state, most of it to find components of the graph.
inline constexpr std::size_t kLaterBytesOfState = 64;

// Rounds of a tick are looked at from so many ticks of the root on that begin in one state
// (verify/rounds.h). Most states have fewer: to look at them costs more than it saves.
inline constexpr std::uint64_t kFewRootTicks = 256;

// The points of a tick at which leaves choose are looked at from so many ticks on that begin in one
// state (verify/tick_points.h), for the same reason.
inline constexpr std::uint64_t kFewTicks = 64;
inline constexpr std::uint64_t kAllTicks = std::numeric_limits<std::uint64_t>::max();

struct SearchProgress {
  std::uint64_t states = 0, waiting = 0, transitions = 0;
  std::uint32_t depth = 0;
  std::size_t memory = 0;
};

// So many values of one entry are not yet a sign that it takes more and more.
inline constexpr std::size_t kUsualValues = 100'000;

struct SearchLimits {
  std::uint64_t states = 5'000'000;
  // Those in which a node asks for more ticks of the root count as often.
  std::uint64_t transitions = std::numeric_limits<std::uint64_t>::max();
  std::size_t memory = std::size_t{1} << 30u;            // bytes
  std::optional<Nanoseconds> time = {};                  // of a real clock
  std::optional<std::uint32_t> depth = {};               // ticks
  std::size_t values = kUsualValues;                     // of one entry
  std::function<int()> stop_signal = {};                 // nonzero: stop; any thread calls it
  std::function<void(const SearchProgress&)> tell = {};  // about ten times a second
  unsigned jobs = 1;                                     // threads; all find the same
  unsigned hash_bits = 0;                                // in place of states; 0: states are kept
  bool symmetry = true;                                  // states of equal children count once
  bool rising_answers = true;  // of equal leaves in equal states: one of all orders
  bool joins = true;   // the answers of children that share nothing (verify/joint_answers.h)
  bool cycles = true;  // their edges have labels
  std::uint64_t few_root_ticks = kFewRootTicks;
  std::uint64_t few_ticks = kFewTicks;
};

enum class SearchEnd : std::uint8_t {
  Complete,
  States,
  Transitions,
  Memory,
  Time,
  Depth,
  Signal,
  Values
};

}  // namespace lockstep::host
