// A measure is a row: its name, unit and axis, what it measures, and the accumulator that computes
// one number for a run. Each file of this folder defines the rows of one idea; measures.cpp lists
// them. A study, `lockstep log measure` and the texts about measures follow from the rows.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "judge/measure/tick_view.h"

namespace lockstep::host {

// NaN: nothing was measured.
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// What comes between two ticks that are measured, if the second is not simply the next one.
enum class Joint : std::uint8_t {
  Lost,  // ticks of which nothing is known, or the begin of the run
  Cut,   // nothing, but leaves may have started again
};

// Measures one run after the other. Does not allocate after construction.
class Accumulator {
 public:
  virtual ~Accumulator() = default;
  virtual void reset() = 0;  // as new, for the next run
  // Called between the two ticks. A measure that compares a tick with the one before starts again.
  virtual void join(Joint) {}
  virtual void after_tick(const TickView& view) = 0;
  virtual double value(const EndView& end) const = 0;
  virtual double gap() const { return kNoValue; }  // only where the row has one
};

enum class MeasureOf : std::uint8_t {
  Run,
  Parallel,  // each parallel of the tree, synchronized or not; or the one that the argument names
  Child,     // the child of a synchronized node that the argument names
  Pair,      // a child of a synchronized node, and another one, which the argument names too
  User,      // the node that uses resources that the argument names
  Pool,      // the pool of resources that the argument names
  Node,      // the node that the argument names
  Entry,     // the blackboard entry that the argument names
};

// Where an accumulator finds its input.
struct MeasureTarget {
  std::size_t place = 0;     // in TickView::parallels (Parallel, Child, Pair)
  std::size_t children = 0;  // of the parallel
  std::size_t child = 0;     // which of them
  std::size_t other = 0;     // which of them the argument names second
  // The node and those around it up to the root (Node), the node (User), or the members (Pool).
  std::vector<NodeIndex> nodes = {};
  std::size_t entry = 0;  // of the Shape (Entry)
};

struct Measure;

// A measure with its argument, as a user asks for it.
struct MeasureSpec {
  const Measure* measure = nullptr;
  std::string argument = {};         // as to_text() writes it: ":arm@0.6=600"
  std::string name = {};             // of the node, the pool or the entry
  std::string other = {};            // of the second node, if it names two
  std::vector<double> numbers = {};  // the rest of the argument; the row knows their meaning

  friend bool operator==(const MeasureSpec&, const MeasureSpec&) = default;
};

// Other facts about a run that gave a value.
struct MeasuredRun {
  std::uint64_t ticks = 0;
  double rate = 0;
  bool succeeded = false;
};

struct Measure {
  std::string_view name;
  std::string_view argument = {};  // as users read it: ":NODE@P[=T]"
  MeasureOf of = MeasureOf::Run;
  std::string_view axis;
  std::string_view unit = {};
  std::string_view doc;
  // Whether there is a second number: the distance of the run from what was requested.
  bool has_gap = false;
  // Whether it looks at which children of the parallel have succeeded.
  bool sees_success = false;
  std::unique_ptr<Accumulator> (*make)(const MeasureSpec& spec, const MeasureTarget& target);
  // Whether a run can have this value. If not, a file with it is damaged.
  bool (*is_possible)(double value, const MeasureSpec& spec, const MeasuredRun& run);
  // Parses what follows the name and the colon, and returns an error or "". Null: it is the name of
  // a node or an entry, as `of` says, or there is no argument.
  std::string (*parse)(std::string_view argument, MeasureSpec& spec) = nullptr;
  // The text for an axis, if it depends on the argument. Null: axis and unit.
  std::string (*label)(const MeasureSpec& spec) = nullptr;
  // Whether it counts from the first tick of the run, so that the rest of a run has no value. Null:
  // the rest has the value of its ticks.
  bool (*counts_from_start)(const MeasureSpec& spec) = nullptr;
};

std::span<const Measure* const> all_measures();

// The argument of a measure of parallels.
inline constexpr std::string_view kOneParallel = "[:PATH]";

// For the rows.
template <class Class>
std::unique_ptr<Accumulator> make_accumulator(const MeasureSpec&, const MeasureTarget& target) {
  return std::make_unique<Class>(target);
}
inline bool is_share(double value, const MeasureSpec&, const MeasuredRun&) {
  return value >= 0 && value <= 1;
}
inline bool is_sum(double value, const MeasureSpec&, const MeasuredRun&) {
  return value >= 0 && std::isfinite(value);
}
inline bool is_count_of_ticks(double value, const MeasureSpec&, const MeasuredRun& run) {
  return value >= 0 && value <= static_cast<double>(run.ticks) && value == std::floor(value);
}

}  // namespace lockstep::host
