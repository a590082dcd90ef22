// The control nodes of trees for BehaviorTree.CPP.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "nodes/btcpp_control_laws.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {}  // namespace

TEST_CASE("BehaviorTree.CPP: sequences and fallbacks") {
  check_rows(kSequences, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: parallels") {
  check_rows(kParallels, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: nodes that choose a child") {
  check_rows(kBranches, FaultPolicy::Stop, btcpp::kRules);
}

}  // namespace lockstep::host::test
