// Leaves that play scripts, or what a leaf file lets them do by chance, in place of those of
// plugins: to the rest of lockstep they are those of an ordinary plugin, which needs no file.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "leaves/leaf_script.h"
#include "leaves/models.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/remote/remote_plugin.h"
#include "tree/definition.h"

namespace lockstep::host {

// Sees each leaf begin, before it writes anything.
class PlayedLeafWatch {
 public:
  virtual ~PlayedLeafWatch() = default;
  virtual void begins(const lockstep_caller& caller) = 0;
};

class PlayedLeaves final : public RemotePlugin {
 public:
  PlayedLeaves();
  PlayedLeaves(const PlayedLeaves&) = delete;
  PlayedLeaves& operator=(const PlayedLeaves&) = delete;

  // All leaves of the definition are of this plugin from now on, also those that no plugin has, and
  // nodes that ask a person: each answer is one of their results. But those of types that stay.
  // This must outlive the definition, and the tree that is made of it.
  using Stays = bool (*)(const NodeType& type);
  void take_over(Definition& definition, Stays stays = nullptr);
  // Before a run. A leaf without a script runs for ever; a condition without one fails.
  void set_scripts(LeafScripts scripts) { scripts_ = std::move(scripts); }
  // Before a run: leaves without a script do what these allow, as the run's random numbers choose.
  // Both must outlive the run.
  void set_models(const Tree& tree, const LeafModels& models) {
    tree_ = &tree;
    models_ = &models;
  }
  // Before a run, which it must outlive; null: nobody looks.
  void set_watch(PlayedLeafWatch* watch) { watch_ = watch; }
  // The mistakes of scripts for a tree: a path that it does not have, a port, a value.
  struct Mistake : Problem {
    std::string leaf;  // its path in the scripts
  };
  static std::optional<Mistake> check(const LeafScripts& scripts, const Tree& tree);

  const lockstep_plugin& entry() const override { return plugin_; }
  std::unique_ptr<RemoteRun> begin_run(const lockstep_caller& caller) override;

 private:
  struct Type {
    lockstep_leaf_type leaf;
    NodeType node;
    // Of a node that asks.
    std::vector<Parameter> parameters = {};
    std::vector<std::string> texts = {};
    std::vector<lockstep_behavior> behavior = {};
  };

  const NodeType* add_type(const NodeType& from);
  const NodeType* add_asking(const Definition& definition, const DefinitionNode& node);

  HostedPlugin plugin_{};
  std::deque<Type> types_;
  LeafScripts scripts_;
  const Tree* tree_ = nullptr;
  const LeafModels* models_ = nullptr;
  PlayedLeafWatch* watch_ = nullptr;
};

}  // namespace lockstep::host
