// Small random trees of both languages, and what their leaves may do: the same seed, the same
// trial.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "property/btcpp_random.h"
#include "property/judged_leaves.h"
#include "property/plan.h"

namespace lockstep::host::test {

struct JudgedTrial {
  Plan plan = {};                     // in lockstep's language
  law::Document document = {};        // or for BehaviorTree.CPP
  std::vector<LeafRule> leaves = {};  // those of the tree, and maybe more
  std::vector<FactRule> facts = {};

  bool is_btcpp() const { return !document.empty(); }
  std::string text() const;
  // Those of the tree, in the order of a walk through it.
  std::vector<LeafRule> rules() const;
  // Of a leaf file.
  std::string rows() const;
};

// Everything is some multiple of it, in seconds.
inline constexpr double kJudgedPeriod = 0.1;
// No node waits, counts or remembers for longer.
inline constexpr double kJudgedLongest = 0.3;

JudgedTrial judged_trial(std::uint64_t seed);
JudgedTrial judged_btcpp_trial(std::uint64_t seed);

// With something taken away.
std::vector<JudgedTrial> smaller(const JudgedTrial& trial);

}  // namespace lockstep::host::test
