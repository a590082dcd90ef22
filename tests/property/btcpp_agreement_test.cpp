// Trees for BehaviorTree.CPP: the engine against the reference of their law, period by period, on
// random documents.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "property/btcpp_tree.h"
#include "property/seeds.h"
#include "support/scripted_run.h"

namespace lockstep::host::test::law {
namespace {

constexpr std::uint64_t kDocuments = 10'000;
constexpr int kPeriods = 12;

// "n = 2 (3 writes)", of those that are there, in the order of their names.
std::string shown(const std::map<std::string, Entry>& entries) {
  std::string text;
  for (const auto& [key, entry] : entries) {
    const auto* number = std::get_if<double>(&entry.value);
    const auto* held = std::get_if<std::string>(&entry.value);
    const std::string value = number != nullptr ? fmt::format("{}", *number)
                              : held != nullptr ? "'" + *held + "'"
                                                : "nothing";
    text += fmt::format("{} = {} ({} writes); ", key, value, entry.writes);
  }
  return text;
}

std::map<std::string, Entry> entries(Ticker& ticker) {
  std::map<std::string, Entry> all;
  for (std::size_t slot = 0; slot < ticker.tree().slots.size(); ++slot) {
    const lockstep::host::Entry& from = ticker.blackboard().entries[slot];
    if (!from.is_present) continue;
    Entry& entry = all[ticker.tree().slots[slot].name];
    entry.writes = from.writes();
    if (const auto* whole = std::get_if<std::int64_t>(&from.value())) {
      entry.value = static_cast<double>(*whole);
    }
    if (const auto* real = std::get_if<double>(&from.value())) entry.value = *real;
    if (const auto* text = std::get_if<std::string>(&from.value())) entry.value = *text;
  }
  return all;
}

// A start value that nothing in its tree names is in the reference only.
std::map<std::string, Entry> known(const ScriptedRun& engine, const Reference& reference) {
  auto all = reference.entries();
  std::erase_if(all, [&](const auto& entry) {
    return std::ranges::find(engine.tree().slots, entry.first, &Slot::name) ==
           engine.tree().slots.end();
  });
  return all;
}

std::string shown(const EventLog& events) {
  std::string text;
  for (const Event& event : events) {
    text += fmt::format("{} {}, ", to_string(event.call), event.leaf);
  }
  return text;
}

// One period; nothing when it ends in a fault.
std::optional<Status> tick(Ticker& ticker, int period) {
  Status status = ticker.tick_root(period * std::chrono::milliseconds(100));
  for (int ticks = 1; ticker.take_request() && status == Status::Running; ++ticks) {
    if (ticks == kMostTicksAtOnce) return std::nullopt;
    status = ticker.tick_root_again();
  }
  return ticker.fault() == nullptr ? std::optional(status) : std::nullopt;
}

struct Outcome {
  std::string difference = {};
  bool has_fault = false;
  bool has_holds = false;
  std::set<Status> results = {};
};

Outcome compared(const Document& document) {
  Outcome outcome;
  ScriptedRun engine(tree_of(document), leaves_text(document));
  Reference reference(document);
  const auto same = [&](int period, std::string_view what, const std::string& got,
                        const std::string& expected) {
    if (got == expected || !outcome.difference.empty()) return;
    outcome.difference =
        fmt::format("period {}: {}: engine {}, reference {}", period, what, got, expected);
  };
  for (int period = 0; period < kPeriods && outcome.difference.empty(); ++period) {
    engine.events.clear();
    reference.events().clear();
    const auto got = tick(engine.ticker(), period);
    const auto expected = reference.tick();
    outcome.has_fault = !expected;
    same(period, "fault", got ? "no" : "yes", expected ? "no" : "yes");
    // At a fault, what still runs is halted, and its scripts run.
    for (EventLog* events : {&engine.events, &reference.events()}) {
      while (!expected && !events->empty() && events->back().call == Call::Halt) {
        events->pop_back();
      }
    }
    same(period, "calls", shown(engine.events), shown(reference.events()));
    outcome.has_holds |=
        std::ranges::find(engine.events, Call::Pause, &Event::call) != engine.events.end();
    if (!expected) break;
    same(period, "entries", shown(entries(engine.ticker())), shown(known(engine, reference)));
    same(period, "result", std::string(to_string(*got)), std::string(to_string(*expected)));
    outcome.results.insert(*expected);
  }
  return outcome;
}

}  // namespace

TEST_CASE("trees for BehaviorTree.CPP do what the law says, on random documents") {
  std::uint64_t faults = 0, holds = 0;
  std::map<Status, std::uint64_t> results;
  const Seeds trials = seeds(1, kDocuments);
  for (std::uint64_t seed = trials.first; seed < trials.first + trials.count; ++seed) {
    const Document document = random_document(seed);
    const Outcome outcome = compared(document);
    if (!outcome.difference.empty()) {
      FAIL("seed " << seed << "; again: ./dev property 1 " << seed << "\n"
                   << outcome.difference << "\n"
                   << leaves_text(document) << "\n"
                   << to_xml(document));
    }
    faults += outcome.has_fault ? 1 : 0;
    holds += outcome.has_holds ? 1 : 0;
    for (const Status result : outcome.results) ++results[result];
  }
  if (trials.count < kDocuments) return;
  // They are not all over before anything has happened.
  CHECK(faults < trials.count / 2);
  for (const Status result : {Status::Running, Status::Success, Status::Failure}) {
    CHECK(results[result] > trials.count / 10);
  }
  CHECK(results[Status::Skipped] > trials.count / 100);
  CHECK(holds > trials.count / 100);
}

}  // namespace lockstep::host::test::law
