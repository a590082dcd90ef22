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
  std::string tree = {};                   // its file; "": that of the file of scenarios
  std::string main = {};                   // of the trees of the file; "": its own main tree
  std::vector<std::string> expected = {};  // properties
  std::string result = {};                 // expected; if there is nothing, the recorded end is
  bool has_limit = true;                   // a run that was cut ends where it was cut
};

// What scenarios are about.
struct ScenarioTree {
  std::string file;       // as the user named it
  std::string main = {};  // of the trees of the file; "": its own main tree
  std::string id = {};    // of that one
};

// <scenario>…</scenario>, indented by two blanks.
std::string to_text(const RecordedWords& words, const ScenarioText& about);
// A file with these scenarios about a tree. An error if XML does not have some character of it.
Result<std::string> scenario_file(const std::string& tree, const std::string& scenarios);
// ScenarioText::tree of scenarios that are added to this file, or with which it is made. An error
// if they cannot be: the file is about another tree, or a scenario cannot name theirs.
Result<std::string> tree_in_scenario_file(const std::string& path, const ScenarioTree& tree);
// Adds them to the end of a file of scenarios, or makes it.
Result<void> add_to_scenario_file(const std::string& path, const ScenarioTree& tree,
                                  const std::string& scenarios);

}  // namespace lockstep::host
