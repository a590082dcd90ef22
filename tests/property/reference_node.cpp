#include "property/reference_node.h"

#include <algorithm>
#include <limits>

#include "property/reference_group.h"

namespace lockstep::host::test {

ReferenceNode::ReferenceNode(Reference& tree, const Plan& its_plan)
    : plan(its_plan), world(*tree.world_), events(tree.events), number(tree.nodes_.size()) {
  tree.nodes_.push_back(this);
  for (const Plan& child : plan.children) {
    children.push_back(make(tree, child));
    children.back()->parent = this;
  }
}

Status ReferenceNode::tick() {
  in_tick = true;
  if (has_ended(status)) {
    for (auto& child : children) child->make_idle();
  }
  status = tick_with_scripts();
  in_tick = false;
  was_ticked = true;
  paused = false;
  last_tick = world.tick;
  for (ReferenceGroup* group : world.groups) group->was_ticked(*this);
  return status;
}

Status ReferenceNode::tick_at_pace(double given) {
  const double around = world.given;
  world.given = given;
  tick();
  world.given = around;
  return status;
}

double ReferenceNode::taken(double between) {
  if (!runs()) return std::numeric_limits<double>::infinity();
  if (children.empty()) return 1 / between;
  double least = std::numeric_limits<double>::infinity();
  for (auto& child : children) least = std::min(least, child->taken(between));
  return least;
}

Status ReferenceNode::tick_with_scripts() {
  const bool first = !runs();
  if (first && asks("failure_if", false)) return ended(decided(Status::Failure));
  if (first && asks("success_if", false)) return ended(decided(Status::Success));
  if (first && asks("skip_if", false)) return decided(Status::Skipped);
  if (asks("while", true)) return ended(on_tick(first));
  make_idle();
  return first ? decided(Status::Skipped) : Status::Skipped;
}

// Before it began.
Status ReferenceNode::decided(Status result) {
  snapshot.clear();  // it asks no child
  return result;
}

Status ReferenceNode::ended(Status result) {
  if (!is_complete(result)) return result;
  run(result == Status::Success ? "on_success" : "on_failure");
  run("on_end");
  return result;
}

bool ReferenceNode::asks(const char* hook, bool otherwise) const {
  const auto script = plan.hooks.find(hook);
  return script == plan.hooks.end() ? otherwise : this->script().holds(script->second);
}

void ReferenceNode::run(const char* hook) const {
  const auto script = plan.hooks.find(hook);
  if (script != plan.hooks.end()) this->script().run(script->second);
}

// Whether it was decided in this moment that it gets no tick: by the parallel that holds it, or a
// node around it, or by the member of a barrier or a pool.
bool ReferenceNode::is_withheld() const {
  const ReferenceNode* held = this;
  const auto is_held = [](const ReferenceNode* node) {
    return node != nullptr && node->paused && !node->in_tick;
  };
  while (is_held(held->parent)) held = held->parent;
  const ReferenceNode* const holder = held->parent;
  if (holder == nullptr) return false;
  const bool compares =
      holder->plan.kind == "ParallelAbsolute" || holder->plan.kind == "ParallelRelative";
  if (!compares) return holder->was_ticked;
  return std::ranges::any_of(holder->children, [](const auto& child) { return child->was_ticked; });
}

// It has begun or completed in this moment, or this tick withholds its ticks; or so it is with
// something below it.
bool ReferenceNode::has_news() const {
  if (paused && is_withheld()) return true;
  const bool is_new = status != Status::Idle && !(runs() && at_begin == Status::Running);
  if (was_ticked && is_new) return true;
  return std::ranges::any_of(children, [](const auto& child) { return child->has_news(); });
}

void Reference::World::begin_moments() {
  moments.clear();
  is_halting = false;
  for (ReferenceNode* node : *nodes) {
    node->in_tick = node->was_ticked = false;
    node->at_begin = node->status;
  }
}

// Nodes that are in their ticks run.
void Reference::World::end_moment() {
  moments.emplace_back();
  for (ReferenceNode* node : *nodes) {
    node->at_begin = node->in_tick ? Status::Running : node->status;
    moments.back().push_back({node->at_begin, node->in_tick || node->last_tick == tick});
    node->was_ticked = false;
  }
}

void ReferenceNode::make_idle() {
  const bool is_outermost = !world.is_halting;
  if (is_outermost && has_news()) world.end_moment();
  world.is_halting = true;
  const bool was_running = runs();
  status = Status::Idle;
  paused = false;
  if (was_running) on_halt();
  for (auto& child : children) child->make_idle();
  if (was_running) run("on_halt");
  if (is_outermost) world.is_halting = false;
}

void ReferenceNode::pause() {
  if (runs() && !paused) {
    paused = true;
    on_pause();
  }
  for (auto& child : children) child->pause();
}

// Not `last_tick` and `snapshot`: these tell what the last tick did.
void ReferenceNode::keep(KeptState& state) {
  state(status, paused);
  state.tick(withheld_in);
}

void ReferenceNode::keep_child(KeptState& state, ReferenceNode*& child) const {
  std::uint8_t place = 0;
  while (place < children.size() && children[place].get() != child) ++place;
  state(place);
  child = place < children.size() ? children[place].get() : nullptr;
}

double ReferenceNode::progress() {
  if (runs()) return on_progress();
  return status == Status::Success ? 1 : 0;
}

}  // namespace lockstep::host::test
