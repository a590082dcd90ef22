// A statement about one tick: statuses, progress and entries, joined by and, or, not. It is
// compiled to a list of steps over a stack of bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/core/status.h"
#include "language/expression/program.h"
#include "language/property/entry_comparison.h"

namespace lockstep::host {

// A node in a tick, exactly as a recording has it.
struct SeenNode {
  Status status = Status::Idle;  // after the tick
  bool ticked = false;
  bool held = false;
  double progress = 0;  // at the start of the tick; needed only where a property compares it
};

struct ProgressComparison {
  std::uint32_t node;  // its place in Formula::nodes, or its index in the tree
  Relation relation;
  double constant;
};

struct FormulaStep {
  enum class What : std::uint8_t { Status, Ticked, Held, Progress, Entry, And, Or, Not };
  What what;
  std::uint8_t statuses = 0;  // of Status: a bit for each
  std::uint32_t place = 0;    // in the list of what it looks at
};
using FormulaCode = std::vector<FormulaStep>;

// Several formulas, and the nodes and entries that they look at.
struct Formula {
  static constexpr std::size_t kDeepest = 30;  // nested parentheses; each needs two bits of a word

  std::vector<std::uint32_t> nodes;  // their indices in the tree
  std::vector<ProgressComparison> progress;
  std::vector<EntryComparison> comparisons;

  bool holds(std::span<const FormulaStep> code, std::span<const SeenNode> seen,
             std::span<const bool> compared) const;
};

}  // namespace lockstep::host
