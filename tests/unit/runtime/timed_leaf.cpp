#include "unit/runtime/timed_leaf.h"

#include <stdexcept>

#include "engine/compile.h"
#include "support/plugin_tables.h"

namespace lockstep::host::test {
namespace {

thread_local std::uint32_t created = 0;

void* create(const lockstep_host*, const lockstep_caller*, void*) {
  return new std::uint32_t(created++);
}

void destroy(void* leaf) {
  --created;
  delete static_cast<std::uint32_t*>(leaf);
}

lockstep_status tick(void* leaf) {
  if (TimedLeaves::on_tick) TimedLeaves::on_tick(*static_cast<std::uint32_t*>(leaf));
  return LOCKSTEP_RUNNING;
}

void halt(void*) {
  ++TimedLeaves::halted;
}

void pause(void*) {
  ++TimedLeaves::paused;
}

void resume(void*) {
  ++TimedLeaves::resumed;
}

const lockstep_leaf_type kLeaf[] = {[] {
  lockstep_leaf_type type = tables::leaf_type("Timed", create, destroy, tick);
  type.halt = halt;
  type.pause = pause;
  type.resume = resume;
  return type;
}()};
const auto kLeaves = tables::list_of(kLeaf);
const lockstep_plugin kPlugin = tables::plugin("timed", kLeaves);

const NodeType& parallel() {
  for (const NodeKind* kind : built_in_kinds()) {
    if (kind->type.id == "Parallel") return kind->type;
  }
  throw std::logic_error("no Parallel");
}

}  // namespace

thread_local std::function<void(std::uint32_t leaf)> TimedLeaves::on_tick;
thread_local std::uint32_t TimedLeaves::halted = 0;
thread_local std::uint32_t TimedLeaves::paused = 0;
thread_local std::uint32_t TimedLeaves::resumed = 0;

TimedLeaves::TimedLeaves(std::uint32_t leaves) {
  on_tick = {};
  halted = paused = resumed = 0;
  Diagnostics diagnostics;
  if (!plugins.add(kPlugin, "timed", diagnostics)) throw std::logic_error("plugin refused");
  Definition definition{.id = "Test", .nodes = {}, .values = {}, .ports = {}, .entries = {}};
  definition.values = {Value(std::int64_t{leaves}), Value(std::int64_t{1}), Value(true)};
  definition.ports = {{.value = 0}, {.value = 1}, {.value = 2}};
  definition.nodes.push_back({&parallel(), leaves + 1, 0, leaves, 0, "all", 0, 0});
  for (std::uint32_t node = 1; node <= leaves; ++node) {
    definition.nodes.push_back({plugins.types()[0], node + 1, 0, 0, 0, "timed", 0, 0});
  }
  tree = compile(definition);
}

}  // namespace lockstep::host::test
