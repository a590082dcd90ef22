#include <catch2/catch.hpp>
#include <stdexcept>

#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

struct RuleRow {
  std::string_view tree;
  std::string_view reason;  // a part of the message; "" = the tree is legal
};

// clang-format off
constexpr RuleRow kRulesRows[] = {
  {"ParallelAbsolute[barriers=.25;.5;1](a b)", ""},
  {"ParallelAbsolute[barriers=](a b)", ""},
  {"ParallelAbsolute[barrier_count=0](a b)", ""},
  {"ParallelAbsolute(a b)", "'barriers' or 'barrier_count' is missing"},
  {"ParallelAbsolute[barriers=.5 barrier_count=2](a b)", "both 'barriers' and 'barrier_count'"},
  {"ParallelAbsolute[barriers=.5;.25](a b)", "barriers must rise"},
  {"ParallelAbsolute[barriers=.5;.25;.5](a b)", "barrier 0.5 is given twice"},
  {"ParallelAbsolute[barriers=.5 at_barrier=stop](a b)", "at_barrier"},
  {"ParallelRelative(a b)", "missing delta"},
  {"ParallelAbsolute[barriers= success_count=3](a b)", "'success_count' is more than the 2 children"},
  {"ParallelRelative[delta=0 failure_count=3](a b)", "'failure_count' is more than the 2 children"},
  {"ParallelRelative[delta=0 success_count=2 failure_count=2](a b)", ""},
  {"Parallel[success_count=2 failure_count=2](a b)", ""},
  {"Parallel[success_count=3](a b)", "'success_count' is more than the 2 children"},
  {"Parallel[failure_count=3](a b)", "'failure_count' is more than the 2 children"},
  {"Repeat(a)", ""},
  {"Retry(a)", "missing attempts"},
  {"Timeout(a)", "missing seconds"},
  {"Delay(a)", "missing seconds"},
  {"Wait", "missing seconds"},
  {"Sequence", "arity"},
  {"Fallback", "arity"},
  {"Parallel", "arity"},
  {"ParallelAbsolute[barriers=.5]", "arity"},
  {"ParallelRelative[delta=0]", "arity"},
  {"Inverter", "arity"},
  {"Inverter(a b)", "arity"},
  {"Repeat(a b)", "arity"},
  {"AlwaysSuccess(a)", "arity"},
  {"Wait[seconds=1](a)", "arity"},
};
// clang-format on

std::string reason_against(std::string_view tree) {
  try {
    tree_from_text(tree);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("what node kinds refuse") {
  for (const RuleRow& row : kRulesRows) {
    INFO(row.tree);
    const std::string reason = reason_against(row.tree);
    CHECK(reason.empty() == row.reason.empty());
    CHECK_THAT(reason, Catch::Contains(std::string(row.reason)));
  }
}

}  // namespace lockstep::host::test
