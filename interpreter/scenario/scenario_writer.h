// Scenarios as text: a recording as a scenario in which the leaves do the same.
#pragma once

#include <string>
#include <vector>

#include "base/core/problem.h"
#include "scenario/recorded_words.h"

namespace lockstep::host {

struct ScenarioText {
  std::string name;
  std::vector<std::string> comments = {};  // lines
  std::string main = {};                   // of the trees of the file; "": its own main tree
  std::vector<std::string> expected = {};  // properties
  std::string result = {};                 // expected; if there is nothing, the recorded end is
  bool has_limit = true;                   // a run that was cut ends where it was cut
};

// <scenario>…</scenario>, indented by two blanks.
std::string to_text(const RecordedWords& words, const ScenarioText& about);
// A file with these scenarios about a tree.
std::string scenario_file(const std::string& tree, const std::string& scenarios);
// Adds them to the end of a file of scenarios, or makes it.
Result<void> add_to_scenario_file(const std::string& path, const std::string& tree,
                                  const std::string& scenarios);

}  // namespace lockstep::host
