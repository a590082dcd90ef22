// A scenario, as the user has written it: a tree, what its leaves do, and what is to come of it.
// docs/testing.md has the reference. Names are as written here; scenario/bound_scenario.h finds
// what they mean in a tree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/place.h"
#include "language/document/sources.h"
#include "leaves/leaf_script.h"

namespace lockstep::host {

inline constexpr double kScenarioRate = 10;                  // Hz, when nothing is said
inline constexpr std::uint64_t kMostScenarioTicks = 10'000;  // likewise

struct NamedText {
  std::string name, text;
  Place place = {};  // of the text's attribute
};

// An entry and its value from a tick on, or from the first at a time or after it.
struct SetEntry {
  std::string key, value;
  Place key_place = {}, value_place = {};
  std::uint64_t tick = 0;
  std::optional<double> time = {};  // s; if it is there, `tick` does not count

  bool is_start() const { return time.value_or(static_cast<double>(tick)) == 0; }
};

// What a person answers: before a tick, or from the first at a time, once; or whenever it is asked.
struct AnswerEvent {
  std::string path, value;
  Place path_place = {}, value_place = {};
  std::optional<std::uint64_t> tick = {};
  std::optional<double> time = {};  // s; if it is there, there is no tick
};

struct LateTick {
  std::uint64_t tick = 0;
  double by = 0;  // s
  Place place = {};
};

// The part that the leaves of a type, or with a path, play.
struct BindingRow {
  enum class From : std::uint8_t { Words, Plugin, Recording };
  std::string of, path;  // one of both
  Place place = {};      // of that attribute
  Place source = {};     // of what it does
  std::vector<LeafWord> words = {};
  std::optional<double> seconds = {};  // the time until a result
  std::vector<std::pair<std::string, std::string>> written = {};
  std::string recording = {};
  From from = From::Words;
  bool restarts = false;    // in each activation
  bool has_result = false;  // the words are made of a result and the time until it
  Status result = Status::Success;
  bool is_fault = false;
  bool may_lack = false;  // the tree need not have such a leaf
};

struct NumberRange {
  double least = 0;
  std::optional<double> most;  // none: without end
};

struct Expectation {
  enum class Kind : std::uint8_t { Ending, Order, SameAs, Text, Inputs } kind = Kind::Ending;
  Place place = {};  // of its first word
  // Ending
  std::vector<std::string> results = {};  // one of these; empty: any
  Place result_place = {};
  std::optional<NumberRange> ticks = {}, time = {};
  Place ticks_place = {}, time_place = {};
  std::string node = {};
  // Order: what comes true; SameAs: the recording; Text: a property or a measure with its limit
  std::vector<std::string> texts = {};
  double tolerance = 0;
  // Inputs: of the leaves of a type, or with a path. Text: `path` is the node that is measured
  std::string of = {}, path = {};
  std::vector<NamedText> inputs = {};
  bool is_for_all = false;  // it is one of the file's, for all scenarios

  bool expects(std::string_view result) const {
    return std::ranges::find(results, result) != results.end();
  }
};

struct Scenario {
  std::string name;
  Place place = {};
  std::string tree, main, leaves;  // files, as they are found from the working directory
  Place tree_place = {}, leaves_place = {};
  double rate = kScenarioRate;
  bool is_rate_given = false;
  bool exactly_once = false;  // a tick of the tree in each period
  std::optional<std::uint64_t> max_ticks = {};
  std::uint64_t seed = 0, runs = 1;
  bool is_verified = false;
  std::vector<NamedText> arguments = {};
  std::vector<SetEntry> changes = {};
  std::vector<BindingRow> bindings = {};
  std::vector<AnswerEvent> answers = {};
  std::vector<LateTick> late = {};
  // The first of them are for all scenarios.
  std::size_t changes_of_file = 0, late_of_file = 0, answers_of_file = 0;
  std::vector<Expectation> expectations = {};
};

struct ScenarioFile {
  std::string path;
  Sources sources;
  std::vector<Scenario> scenarios;
};

}  // namespace lockstep::host
