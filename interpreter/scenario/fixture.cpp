#include "scenario/fixture.h"

#include <utility>

#include "engine/compile.h"
#include "judge/measure/property_steps.h"
#include "run/loading/project_file.h"
#include "run/shape_of.h"
#include "tree/pace.h"

namespace lockstep::host {
namespace {

// All leaves but these are played.
Tree played_tree(const Definition& given, const std::set<NodeIndex>& real, PlayedLeaves& played) {
  Definition definition = given;
  played.take_over(definition);
  for (const NodeIndex node : real) definition.nodes[node].type = given.nodes[node].type;
  return compile(definition);
}

// What verify and coverage search.
Tree searched_tree(Definition definition, PlayedLeaves& played) {
  ignore_pace(definition);
  return played_tree(definition, {}, played);
}

}  // namespace

Fixture::Key Fixture::key_of(const Scenario& scenario) {
  Key key{scenario.tree, scenario.main, {}};
  for (const NamedText& it : scenario.arguments) key.arguments[it.name] = it.text;
  return key;
}

StartValues Fixture::start_values(const Scenario& scenario) {
  StartValues values;
  for (const SetEntry& it : scenario.changes) {
    if (it.is_start()) values[it.key] = it.value;
  }
  return values;
}

StartValues Fixture::later_values(const Scenario& scenario) {
  StartValues values;
  for (const SetEntry& it : scenario.changes) {
    if (!it.is_start()) values.try_emplace(it.key, it.value);
  }
  return values;
}

std::shared_ptr<const Fixture> Fixture::load(const Key& key, const std::string* text,
                                             const LoadOptions& options, Diagnostics& diagnostics,
                                             const std::shared_ptr<PluginSet>& plugins,
                                             LoadFailure& failure) {
  LoadOptions load = with_project_file(key.tree, options, diagnostics);
  load.arguments = key.arguments;
  load.values = key.values;
  load.later = key.later;
  load.main_tree = key.main;
  load.main_file = MainFile::IsRegular;
  load.unknown = MissingNodes::AreMocked;
  auto loaded = text == nullptr ? host::load(key.tree, load, diagnostics, plugins)
                                : load_text(key.tree, *text, load, diagnostics, plugins);
  if (!loaded) {
    failure = loaded.error();
    return nullptr;
  }
  return std::shared_ptr<const Fixture>(new Fixture(key.tree, std::move(*loaded)));
}

Fixture::Fixture(std::string file, Loaded loaded)
    : file_(std::move(file)),
      loaded_(std::move(loaded)),
      tree_(searched_tree(loaded_.definition, played_)),
      names_(property_names(shape_of(tree_))) {}

SourceLocation Fixture::location_of(NodeIndex node) const {
  return sources().locate(loaded_.definition.nodes[node].place);
}

std::string Fixture::place_of(NodeIndex node) const {
  return to_text(location_of(node));
}

StubLeaves::StubLeaves(std::shared_ptr<const Fixture> fixture, const std::set<NodeIndex>& real)
    : fixture_(std::move(fixture)), tree_(played_tree(fixture_->definition(), real, played_)) {}

}  // namespace lockstep::host
