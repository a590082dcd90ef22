// The entry of a plugin: what BT_REGISTER_NODES registers, as the host reads it. Included by
// bt_factory.h.
#pragma once

#include <dlfcn.h>
#include <lockstep/leaf.h>

#include <memory>
#include <string>

#include "behaviortree_cpp/bt_factory.h"

namespace BT::lockstep_detail {

// One for each shared object; it lives until the process ends.
[[gnu::visibility("hidden")]] inline BehaviorTreeFactory& plugin_factory() {
  static auto& factory = *new BehaviorTreeFactory;
  return factory;
}

inline PluginTable& made_table() {
  return making != nullptr ? *making : plugin_factory().lockstep_table();
}
inline bool reads_object(std::type_index type, const char* name) {
  const auto sources = made_table().casts()->lockstep_sources(type);
  return std::any_of(sources.begin(), sources.end(),
                     [name](std::type_index it) { return object_name(it) == name; });
}
inline const Registration* find_registration(const std::string& id) {
  return made_table().find(id);
}
inline const NodeNumber* number_of(const std::string& path) {
  if (making == nullptr) return nullptr;
  const auto found = making->numbers.find(path);
  return found == making->numbers.end() ? nullptr : &found->second;
}
inline void note_made(const std::string& path, TreeNode& node) {
  if (making != nullptr) making->made[path] = &node;
}
inline const std::shared_ptr<PolymorphicCastRegistry>& registered_casts() {
  return made_table().casts();
}
inline const std::shared_ptr<ScriptingEnumsRegistry>& registered_enums() {
  return made_table().words();
}

// The name of the file without "lib" in front and what is behind the first point.
inline std::string plugin_name(const void* in_plugin) {
  Dl_info info{};
  if (dladdr(in_plugin, &info) == 0 || info.dli_fname == nullptr) return "plugin";
  std::string name = info.dli_fname;
  name.erase(0, name.rfind('/') + 1);
  name.erase(std::min(name.find('.'), name.size()));
  return StartWith(name, "lib") ? name.substr(3) : name;
}

// Runs the body of BT_REGISTER_NODES, once.
template <void (*Register)(BehaviorTreeFactory&)>
[[gnu::visibility("hidden")]] const lockstep_plugin* describe(const char** why) {
  static std::string error;
  static const lockstep_plugin* const plugin = []() -> const lockstep_plugin* {
    const lockstep_plugin* described = nullptr;
    lockstep::detail::catching(
        [&] {
          Register(plugin_factory());
          const auto* const here = reinterpret_cast<const void*>(&describe<Register>);
          described =
              &plugin_factory().lockstep_table().describe(plugin_name(here), table_extension);
        },
        [](const char* message) { error = message; });
    return described;
  }();
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
#define BT_REGISTER_NODES(factory)                         \
  [[maybe_unused]] static void BT_RegisterNodesFromPlugin( \
      [[maybe_unused]] BT::BehaviorTreeFactory& factory)
#endif
