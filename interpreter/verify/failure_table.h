// What a tree does when one leaf, or two, fail in one of the ways in which leaves do: a table of
// failure modes and effects, from a search for each row.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "verify/search.h"

namespace lockstep::host {

enum class LeafFailure : std::uint8_t {
  AtOnce,      // it fails in its first tick; a condition is never true
  Late,        // it fails as late as its model lets it end
  NeverEnds,   // it runs until it is halted
  Fault,       // it fails as a program
  Slow,        // it succeeds, but kSlowSeconds later than its model says
  NoProgress,  // it succeeds, but its progress stays 0
};
inline constexpr double kSlowSeconds = 5;
std::string_view to_string(LeafFailure failure);

struct FailureCase {
  std::uint32_t leaf;  // in Tree::leaves
  LeafFailure failure;
};

struct FailureRow {
  std::vector<FailureCase> cases;
  bool is_complete = true;   // else the search had a limit, and more may happen
  bool may_not_end = false;  // for ever
  bool faults = false;       // the run ends so, without --on-fault fail
  // By status: the tree may have this result, first after so many ticks.
  std::array<std::optional<std::uint32_t>, kStatuses.size()> results = {};
  std::vector<NodeIndex> halted = {};  // leaves, in some run
  // Of a complete search. The lowest node around the leaf that never fails: what is above does not
  // notice.
  std::optional<NodeIndex> handled_by = {};
  std::vector<NodeIndex> not_tried = {};   // leaves that are ticked where nothing fails
  std::vector<std::size_t> violated = {};  // properties, by their place

  // Neither a failure of the tree nor worse.
  bool is_harmless() const {
    return is_complete && !may_not_end && !faults && violated.empty() &&
           !results[index_of(Status::Failure)];
  }
};

struct FailureTableOptions {
  double rate = 10;
  bool pairs = false;                     // also each two failures of different leaves
  SearchLimits limits = {};               // of each row
  std::optional<Nanoseconds> until = {};  // of monotonic_now: of all rows
};

// All other actions succeed, at a time that their models allow; conditions and facts are as the
// models allow. Stops before a row when limits.stop_signal says so.
std::vector<FailureRow> failure_table(const Tree& tree, const LeafModels& models,
                                      std::span<const Property> properties,
                                      const FailureTableOptions& options);

}  // namespace lockstep::host
