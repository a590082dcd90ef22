#include "property/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

namespace lockstep::host::test {
namespace {

constexpr long kOften = 1000;
constexpr long kSeldom = 100;
constexpr long kRarely = 10;

std::string kind_and_status(std::string_view kind, Status status) {
  return fmt::format("{} {}", kind, to_string(status));
}

// What a node of a kind can never return. A script around its ticks may give any other result.
constexpr std::array kNever{
    "AlwaysSuccess running", "AlwaysFailure running", "Condition running", "Script running",
    "Check running",         "barrier failure",       "barrier skipped",   "resources success",
    "resources failure",     "resources skipped",
};

constexpr std::array kFaults{"error of the script", "threw", "returned", "is a condition",
                             "reported a progress"};

}  // namespace

void Coverage::count(ScriptedRun& run) {
  const Ticker& ticker = run.ticker();
  if (ticker.tick_number() == 1) paused_.assign(run.tree().leaves.size(), false);
  if (const Fault* fault = ticker.fault()) count_fault(fault->message);
  for (NodeIndex node = 0; node < run.tree().nodes.size(); ++node) {
    if (!ticker.ticked(node)) continue;
    ++seen_[kind_and_status(run.tree().nodes[node].kind->type.id, ticker.status(node))];
  }
  if (is_complete(ticker.status(0))) ++seen_["root completes"];
  for (const Event& event : run.events) count_event(event);
}

void Coverage::count_event(const Event& event) {
  ++seen_[std::string(to_string(event.call))];
  if (event.call == Call::Halt && paused_[event.leaf]) ++seen_["halt while paused"];
  paused_[event.leaf] = event.call == Call::Pause;
}

void Coverage::count_fault(std::string_view message) {
  for (const std::string_view fault : kFaults) {
    if (message.starts_with(fault)) ++seen_[std::string(fault)];
  }
}

void Coverage::at_least(long times, const std::string& what) const {
  const auto seen = seen_.find(what);
  INFO("how often: " << what);
  CHECK((seen == seen_.end() ? 0 : seen->second) >= times);
}

void Coverage::check() const {
  std::vector<const NodeKind*> kinds(built_in_kinds().begin(), built_in_kinds().end());
  kinds.insert(kinds.end(), {&kPluginAction, &kPluginCondition});
  for (const NodeKind* kind : kinds) {
    // Robots that run other trees: tests/property/team_test.cpp.
    if (kind->type.id == "InStep" || kind->type.is_of_robots) continue;
    for (const Status status :
         {Status::Running, Status::Success, Status::Failure, Status::Skipped}) {
      const std::string what = kind_and_status(kind->type.id, status);
      if (std::find(kNever.begin(), kNever.end(), what) != kNever.end()) {
        CHECK(seen_.count(what) == 0);
      } else {
        at_least(kSeldom, what);
      }
    }
  }
  for (const char* call : {"start", "tick", "halt", "pause", "resume", "halt while paused"}) {
    at_least(kOften, call);
  }
  at_least(kOften, "root completes");
  for (const char* fault : kFaults) at_least(kRarely, fault);
}

}  // namespace lockstep::host::test
