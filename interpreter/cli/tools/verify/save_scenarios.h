// `verify --save`: counter-examples as scenarios, which `lockstep test` plays again.
#pragma once

#include <optional>
#include <string>

#include "cli/tools/verify/verify_report.h"
#include "leaves/play/played_leaves.h"
#include "scenario/scenario_writer.h"
#include "verify/trace.h"

namespace lockstep::host {

// What the findings are about.
struct VerifiedTree {
  const Tree& tree;
  const std::string& main;  // "": the main tree of the file
  const LeafModels& models;
  const std::vector<Property>& properties;
  double rate;
  Tracer& tracer;
  PlayedLeaves& played;
};

// ScenarioText::tree of the scenarios. Nothing, with a message, if they cannot be in this file.
std::optional<std::string> tree_to_save(const std::string& path, const ScenarioTree& of);

// Adds a scenario for each finding that has a recording: it fails as long as the tree has what was
// found. False, with a message, if it cannot.
bool save_scenarios(const std::string& path, const VerifyReport& report, const VerifiedTree& of);

}  // namespace lockstep::host
