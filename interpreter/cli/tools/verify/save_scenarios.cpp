#include "cli/tools/verify/save_scenarios.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "scenario/recorded_words.h"
#include "scenario/scenario_writer.h"
#include "verify/property_watch.h"

namespace lockstep::host {
namespace {

// The scenario expects that a property holds which some behavior violates. For the rest it
// expects what came: a person has to say what should come.
ScenarioText text_of(const Finding& finding, const std::vector<Property>& properties,
                     const Tree& tree) {
  ScenarioText text{.name = "verify: " + finding.name,
                    .comments = {"found by verify: " + finding.message}};
  for (const Property& property : properties) {
    const bool is_meant = finding.name == "property/" + property.name();
    if (is_meant && !names_fact(property, tree)) text.expected.push_back(property.text());
  }
  return text;
}

}  // namespace

bool save_scenarios(const std::string& path, const VerifyReport& report, const Tree& tree,
                    const std::vector<Property>& properties) {
  std::string scenarios;
  for (const Finding& finding : report.verdict.findings) {
    const auto files = report.files.find(finding.name);
    if (files == report.files.end()) continue;
    RecordedWords words = read_recorded_words(files->second.recording, tree);
    if (!words.outcome.error.empty()) {
      print_error("--save: " + words.outcome.error);
      return false;
    }
    // A recording does not tell the result of a leaf from that of a script around it.
    words.leaves = files->second.scripts.leaves;
    scenarios += to_text(words, text_of(finding, properties, tree));
  }
  if (scenarios.empty()) return true;
  const auto saved = add_to_scenario_file(path, report.tree, scenarios);
  if (!saved) print_error("--save: " + saved.error().message, saved.error().hint);
  return saved.has_value();
}

}  // namespace lockstep::host
