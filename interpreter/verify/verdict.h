// A verdict is what a search says about a tree: findings, each with a stable name and a run that
// shows it, and what else is known.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/trace.h"

namespace lockstep::host {

struct Finding {
  std::string name;                         // "trap", "never-ticked/Main/arm"
  std::string message;                      // a line
  std::vector<std::string> more = {};       // lines that say why
  std::optional<NodeIndex> node = {};       // where
  TracedRun run = {};                       // that shows it; empty: there is none to show
  std::size_t decided = 0;                  // of a trap: after so many ticks of it
  std::optional<std::size_t> repeats = {};  // from this tick of it, counted from 0, for ever
  std::vector<std::size_t> cuts = {};       // the process is cut before these ticks of it
  std::string accepted = {};                // why it is as it should be

  std::size_t round() const { return (run.size() - *repeats) / 2; }  // ticks, of the two it has
};

// A line of information.
struct VerdictLine {
  std::string name, text;
  bool is_good = false;  // the answer to a question that has a wrong one
};

struct Verdict {
  std::vector<Finding> findings;  // those of which it is sure
  std::vector<VerdictLine> facts;
  std::vector<std::string> assumed;
  bool is_cut = false;       // the time was over before each question was answered
  std::size_t left_out = 0;  // findings that are not accepted, by keep_only

  bool has_findings() const;  // that are not accepted
  // Leaves out the findings whose names none of these patterns means.
  void keep_only(std::span<const std::string> patterns);
};

struct VerdictOptions {
  double rate = 10;
  // Where a node is written, for messages: "tree.xml:5:9".
  std::function<std::string(NodeIndex)> place = {};
  std::optional<Nanoseconds> until = {};  // of monotonic_now; what was found is shown after it, too
  std::size_t memory = std::numeric_limits<std::size_t>::max();
  bool paces = false;  // nodes of the tree pace: the search is of the tree without that
};

// That a property is violated: "property/close".
inline constexpr std::string_view kPropertyFinding = "property/";
std::string name_of_finding(const Property& property);

// The names of all findings that the tree could have. Those of a kind with a part, such as
// "property/close", also without it: "property/".
std::vector<std::string> possible_findings(const Tree& tree, std::span<const Property> properties);
// Whether a pattern such as "never-ticked/*" is of a kind of `possible`; without '*', one of them.
bool may_mean_finding(std::string_view pattern, std::span<const std::string> possible);

Verdict make_verdict(const Tree& tree, const LeafModels& models,
                     std::span<const Property> properties, const SearchResult& found,
                     const VerdictOptions& options);

}  // namespace lockstep::host
