// A scenario found in its tree: what its names mean there, ready for runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/measure/measure.h"
#include "scenario/fixture.h"
#include "scenario/leaf_bindings.h"

namespace lockstep::host {

// A value that an entry gets before a tick.
struct PreparedChange {
  std::uint32_t slot;
  Value value;
  std::uint64_t tick;
  std::optional<double> time;
  Place place;  // of the value
};

// An answer of a person to this node.
struct PreparedAnswer {
  NodeIndex node;
  std::uint32_t option;
  const AnswerEvent* of;
};

struct PreparedProperty {
  Property property;
  const Expectation* of;
};

// "spread < 0.1"
struct PreparedLimit {
  MeasureSpec measure;
  Relation relation;
  double limit;
  std::string text;
  const Expectation* of;
};

// The value that leaves get at a port whenever they begin.
struct PreparedInput {
  std::vector<NodeIndex> leaves;  // in order
  std::string port, text;         // as a value of the port's type is written
  Place place;
  const Expectation* of;
};

struct BoundScenario {
  const Scenario* scenario = nullptr;
  double rate = kScenarioRate;
  LeafBindings bindings;
  std::shared_ptr<const LeafModels> models;  // null: there is no leaf file
  std::vector<PreparedChange> changes;
  std::vector<PreparedAnswer> answers;
  std::vector<PreparedProperty> properties;
  std::vector<PreparedLimit> limits;
  std::vector<PreparedInput> inputs;
};

// Reports errors at their places. `file` is the scenario's leaf file, or null. All must outlive
// what this returns.
BoundScenario bind_scenario(const Scenario& scenario, const Sources& sources,
                            const Fixture& fixture, const LeafFile* file, MissingLeaves missing,
                            Diagnostics& diagnostics);

}  // namespace lockstep::host
