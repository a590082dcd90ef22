// A tree that scenarios are played on: loaded once for all of them, and compiled with leaves that
// play words instead of those of plugins, for each thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "language/property/property.h"
#include "leaves/play/played_leaves.h"
#include "run/loading/load.h"
#include "scenario/scenario.h"

namespace lockstep::host {

class Fixture {
 public:
  // The file and the values that a tree is loaded with; equal keys have the same fixture.
  struct Key {
    std::string tree, main;
    Arguments arguments;
    // Of entries that nothing in the tree declares: before the first tick, and first after it.
    StartValues values = {}, later = {};
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  static Key key_of(const Scenario& scenario);
  // What the scenario writes into entries before the first tick.
  static StartValues start_values(const Scenario& scenario);
  // And later: the first value of each entry.
  static StartValues later_values(const Scenario& scenario);

  // Null, with errors, if it cannot be loaded; `failure` says why. `text` is in place of the main
  // file, or null. Several share `plugins`.
  static std::shared_ptr<const Fixture> load(const Key& key, const std::string* text,
                                             const LoadOptions& options, Diagnostics& diagnostics,
                                             const std::shared_ptr<PluginSet>& plugins,
                                             LoadFailure& failure);

  const std::string& file() const { return file_; }
  // With the values that are in force.
  const std::vector<DeclaredArgument>& arguments() const { return loaded_.project->arguments; }
  const Definition& definition() const { return loaded_.definition; }
  // The tree with stubs in place of all leaves and without pace, and what properties may name in
  // it.
  const Tree& tree() const { return tree_; }
  const PropertyNames& names() const { return names_; }
  const std::vector<Property>& properties() const { return loaded_.properties; }
  // "tree.xml:5:9"
  std::string place_of(NodeIndex node) const;
  SourceLocation location_of(NodeIndex node) const;
  const Sources& sources() const { return loaded_.project->sources; }

 private:
  Fixture(std::string file, Loaded loaded);

  std::string file_;  // the main one
  Loaded loaded_;
  PlayedLeaves played_;
  Tree tree_;
  PropertyNames names_;
};

// The stubs of a fixture, for one thread.
class StubLeaves {
 public:
  // `real` are leaves that plugins play themselves.
  StubLeaves(std::shared_ptr<const Fixture> fixture, const std::set<NodeIndex>& real);
  StubLeaves(const StubLeaves&) = delete;
  StubLeaves& operator=(const StubLeaves&) = delete;

  const Fixture& fixture() const { return *fixture_; }
  const Tree& tree() const { return tree_; }
  PlayedLeaves& leaves() { return played_; }

 private:
  std::shared_ptr<const Fixture> fixture_;
  PlayedLeaves played_;
  Tree tree_;
};

}  // namespace lockstep::host
