// Of the reference interpreter: a node that calls its children, and what all nodes share.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "property/mini_script.h"
#include "property/reference.h"

namespace lockstep::host::test {

struct Reference::World {
  Nanoseconds now{0};
  std::uint32_t tick = 0;  // the first is 1
  std::optional<std::size_t> fault;
  std::uint32_t leaves = 0;
  LeafBehavior* behavior = nullptr;
  Entries entries;
  std::vector<ReferenceGroup*> groups;
  std::map<std::string, long> cases;  // of the law, by name: how often they came up
  const std::vector<ReferenceNode*>* nodes = nullptr;
  std::vector<ReferenceMoment> moments;  // of this tick, but for the last one
  bool is_halting = false;
  double given = 0;  // the pace of what is ticked now; 0: nothing was asked

  void begin_moments();
  void end_moment();
};

class ReferenceNode {
 public:
  using Children = std::vector<std::unique_ptr<ReferenceNode>>;

  ReferenceNode(Reference& tree, const Plan& its_plan);
  virtual ~ReferenceNode() = default;
  static std::unique_ptr<ReferenceNode> make(Reference& tree, const Plan& plan);

  Status tick();
  Status tick_at_pace(double given);
  // Halts what runs; all of the subtree is idle then.
  void make_idle();
  void pause();
  double progress();

  bool asks(const char* hook, bool otherwise) const;
  void run(const char* hook) const;
  MiniScript script() const { return {world.entries, number, meanings}; }
  void note(const std::string& what) const {
    if (world.behavior == nullptr) ++world.cases[what];
  }

  virtual Status on_tick(bool first) = 0;
  virtual double on_progress() = 0;
  // Of one with hold="between": a branch that has come so far within this tick is held. Nobody else
  // asks how far that is.
  virtual bool is_reached_between(const std::function<double()>& /*progress*/) const {
    return false;
  }
  virtual void on_halt() {}
  // The least that its running leaves took up of their pace, each divided by what nodes from here
  // to it asked, and by `between`.
  virtual double taken(double between);
  virtual void on_pause() {}
  virtual bool on_cut() { return false; }  // it is a leaf that ran
  // What the next ticks read of it.
  virtual void keep(KeptState& state);

  // One of its children, or none.
  void keep_child(KeptState& state, ReferenceNode*& child) const;

  ReferenceNode& child() { return *children.front(); }
  bool runs() const { return status == Status::Running; }

  ReferenceNode* parent = nullptr;
  const Plan& plan;
  Reference::World& world;
  EventLog& events;
  std::size_t number;
  Children children;
  Status status = Status::Idle;
  bool paused = false;
  std::uint32_t last_tick = 0;
  std::uint32_t withheld_in = 0;  // the last tick in which its synchronized parallel held it
  std::vector<double> snapshot;
  Meanings meanings;  // of its scripts
  // Of this moment.
  bool in_tick = false;
  bool was_ticked = false;
  Status at_begin = Status::Idle;

 private:
  bool has_news() const;
  bool is_withheld() const;
  Status tick_with_scripts();
  Status decided(Status result);
  Status ended(Status result);
};

}  // namespace lockstep::host::test
