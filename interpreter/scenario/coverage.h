// How much of trees their scenarios show: each node and what may be seen of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenario/fixture.h"
#include "scenario/node_coverage.h"
#include "scenario/test_run.h"

namespace lockstep::host {

struct CoveredNode {
  std::string path, kind;
  SourceLocation place;
  AspectSet seen, possible;
  std::uint64_t ticks = 0;
  std::map<double, bool> barriers = {};  // whether somebody has waited at it; those that can be
  std::array<std::vector<std::string>, kAspectCount> by = {};  // the first scenarios that show it

  std::size_t all() const;    // that may be seen
  std::size_t shown() const;  // of these
};

struct CoveredTree {
  std::string file;  // the main one
  std::string id;
  bool is_proved = true;  // what is possible; else it is what is usual
  std::vector<CoveredNode> nodes = {};

  std::size_t all() const;
  std::size_t shown() const;
};

// Collects from one thread.
class Coverage {
 public:
  // The scenario was played; its leaf file must outlive this.
  void add(const ScenarioReport& report);
  // Searches for what is possible, once for each fixture, on so many threads.
  std::vector<CoveredTree> trees(unsigned jobs);

 private:
  struct Played {
    std::shared_ptr<const Fixture> fixture;
    const LeafFile* leaves;  // null: there is none
    double rate;
    NodeCoverage coverage;
    std::map<NodeIndex, std::array<std::vector<std::string>, kAspectCount>> by;
    std::optional<NodeCoverage> possible = {};  // nothing: it is not known
  };
  void find_possible(unsigned jobs);
  void merge(const Played& played, CoveredTree& into,
             std::map<std::string, std::size_t>& numbers) const;

  std::vector<Played> fixtures_;  // in the order in which they came
};

// "98.1 %"; all of nothing is 100.
double percent(std::span<const CoveredTree> trees);

std::string to_table(std::span<const CoveredTree> trees);
// One page with the trees in color.
std::string to_page(std::span<const CoveredTree> trees);
// For those who want lines of XML: a line for each node, a branch for each aspect.
std::string to_lcov(std::span<const CoveredTree> trees);

}  // namespace lockstep::host
