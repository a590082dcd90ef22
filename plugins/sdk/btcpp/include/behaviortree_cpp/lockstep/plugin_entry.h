// The entry of a plugin: what BT_REGISTER_NODES registers, as the host reads it. Included by
// bt_factory.h.
#pragma once

#include <lockstep/leaf.h>

#include <string>

#include "behaviortree_cpp/bt_factory.h"

namespace BT::lockstep_detail {

// Runs `register_nodes`, and describes what it has registered; null: `error` says why not. `here`
// is an address in the plugin.
[[gnu::visibility("hidden")]] const lockstep_plugin* describe(
    void (*register_nodes)(BehaviorTreeFactory&), const void* here, std::string& error);

// Runs the body of BT_REGISTER_NODES, once.
template <void (*Register)(BehaviorTreeFactory&)>
[[gnu::visibility("hidden")]] const lockstep_plugin* describe(const char** why) {
  static std::string error;
  static const lockstep_plugin* const plugin =
      describe(Register, reinterpret_cast<const void*>(&describe<Register>), error);
  *why = error.c_str();
  return plugin;
}

template <void (*Register)(BehaviorTreeFactory&)>
constexpr lockstep_plugin plugin_entry() {
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.describe = &describe<Register>;
  return plugin;
}

}  // namespace BT::lockstep_detail

// Registers nodes: BT_REGISTER_NODES(factory) { factory.registerNodeType<Move>("Move"); }. With
// BT_PLUGIN_EXPORT it makes the shared object a plugin; without, it is a function of this file.
#ifdef BT_PLUGIN_EXPORT
#define BT_REGISTER_NODES(factory)                                                   \
  extern "C" __attribute__((visibility("default"))) void BT_RegisterNodesFromPlugin( \
      BT::BehaviorTreeFactory&);                                                     \
  extern "C" {                                                                       \
  constexpr lockstep_plugin lockstep_plugin_entry =                                  \
      BT::lockstep_detail::plugin_entry<&BT_RegisterNodesFromPlugin>();              \
  }                                                                                  \
  void BT_RegisterNodesFromPlugin([[maybe_unused]] BT::BehaviorTreeFactory& factory)
#else
// NOLINTBEGIN(bugprone-macro-parentheses): it is a name
#define BT_REGISTER_NODES(factory)                         \
  [[maybe_unused]] static void BT_RegisterNodesFromPlugin( \
      [[maybe_unused]] BT::BehaviorTreeFactory& factory)
// NOLINTEND(bugprone-macro-parentheses)
#endif
