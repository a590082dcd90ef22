#include "leaves/plugin/contract/descriptor.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "leaves/plugin/contract/described_types.h"
#include "leaves/plugin/contract/descriptor_leaf.h"
#include "leaves/plugin/contract/descriptor_port.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kHandshakeSize =
    offsetof(lockstep_plugin, struct_size) + sizeof(lockstep_plugin::struct_size);
constexpr std::size_t kPluginSizeIn10 =
    offsetof(lockstep_plugin, get_extension) + sizeof(lockstep_plugin::get_extension);

std::optional<Problem> check_handshake(const lockstep_plugin& entry, std::size_t exported_size) {
  if (exported_size != 0 && exported_size < kHandshakeSize) {
    return Problem{
        fmt::format("exports a constant of {} bytes, expected a lockstep_plugin", exported_size),
        "define lockstep_plugin_entry as in `lockstep docs plugins`"};
  }
  if (entry.abi_major != LOCKSTEP_ABI_MAJOR) {
    return Problem{
        fmt::format("was built for plugin ABI {}.{}, this program has {}.{}", entry.abi_major,
                    entry.abi_minor, LOCKSTEP_ABI_MAJOR, LOCKSTEP_ABI_MINOR),
        "build it with the lockstep/leaf.h of this version"};
  }
  const bool too_long = exported_size != 0 && entry.struct_size > exported_size;
  if (entry.struct_size < kPluginSizeIn10 || too_long) {
    return Problem{
        fmt::format("has a lockstep_plugin with struct_size {}, expected {} {}", entry.struct_size,
                    too_long ? "at most" : "at least", too_long ? exported_size : kPluginSizeIn10),
        "set it to sizeof(lockstep_plugin)"};
  }
  return std::nullopt;
}

// The table that the plugin makes itself, in the place of its constant.
std::optional<Problem> describe(lockstep_plugin& plugin) {
  if (plugin.describe == nullptr) return std::nullopt;
  const char* why = nullptr;
  const lockstep_plugin* described = nullptr;
  const char* const name = plugin.name == nullptr ? "" : plugin.name;
  const MarkedCall mark(CallSite::of_plugin(name), PluginFunction::Describe);
  const std::string thrown = thrown_by([&] { described = plugin.describe(&why); });
  constexpr const char* kHint = "the author of the plugin knows what it needs";
  if (!thrown.empty()) return Problem{"cannot be used: its describe " + thrown, kHint};
  if (described == nullptr) {
    return Problem{fmt::format("cannot be used: {}", why == nullptr ? "it gives no reason" : why),
                   kHint};
  }
  if (auto refusal = check_handshake(*described, 0)) return refusal;
  plugin = covered_copy(described, described->struct_size);
  plugin.describe = nullptr;
  return std::nullopt;
}

std::optional<Problem> check_plugin(const lockstep_plugin& plugin) {
  if (plugin.name == nullptr) return Problem{"has no name", "set lockstep_plugin::name"};
  if (!is_plugin_name(plugin.name)) {
    return Problem{fmt::format("is named '{}'", plugin.name),
                   "a plugin's name is made of letters, digits, '_' and '-'"};
  }
  if (plugin.leaf_type_count > kMaxDescriptorCount) {
    return Problem{fmt::format("claims to have {} leaf types, expected at most {}",
                               plugin.leaf_type_count, kMaxDescriptorCount),
                   "check lockstep_plugin::leaf_type_count"};
  }
  if (plugin.leaf_type_count != 0 && plugin.leaf_types == nullptr) {
    return Problem{fmt::format("has {} leaf types but no list of them", plugin.leaf_type_count),
                   "set lockstep_plugin::leaf_types"};
  }
  if ((plugin.create_run == nullptr) != (plugin.destroy_run == nullptr)) {
    return Problem{fmt::format("has {} without {}",
                               plugin.create_run != nullptr ? "create_run" : "destroy_run",
                               plugin.create_run != nullptr ? "destroy_run" : "create_run"),
                   "a plugin has both or none"};
  }
  return std::nullopt;
}

NodeCategory category_of(lockstep_leaf_kind kind) {
  constexpr NodeCategory kCategories[] = {NodeCategory::Action, NodeCategory::Condition,
                                          NodeCategory::Control, NodeCategory::Decorator};
  return kCategories[kind - LOCKSTEP_ACTION];
}

Arity arity_of(const lockstep_leaf_type& leaf) {
  if (leaf.kind == LOCKSTEP_DECORATOR) return {1, 1};
  if (leaf.kind != LOCKSTEP_CONTROL) return {0, 0};
  Arity arity{.min = std::max(leaf.min_children, 1u)};
  if (leaf.max_children != 0) arity.max = leaf.max_children;
  return arity;
}

// Whether running may be its own result.
bool can_run(const lockstep_leaf_type& leaf) {
  if (leaf.kind == LOCKSTEP_CONDITION) return (leaf.flags & LOCKSTEP_MAY_RUN) != 0;
  return (leaf.flags & LOCKSTEP_AT_ONCE) == 0;
}

}  // namespace

NodeType node_type_of(const HostedPlugin& plugin, const Descriptors::Leaf& leaf) {
  const bool is_action = leaf.type.kind == LOCKSTEP_ACTION;
  return NodeType{.id = leaf.type.id,
                  .category = category_of(leaf.type.kind),
                  .doc = text_or_empty(leaf.type.doc),
                  .arity = arity_of(leaf.type),
                  .parameters = leaf.parameters,
                  .can_run = can_run(leaf.type),
                  .real_time = (leaf.type.flags & LOCKSTEP_REAL_TIME) != 0,
                  .has_progress = !is_action || leaf.type.progress != nullptr,
                  .can_be_slowed = is_action && leaf.type.set_pace != nullptr,
                  .can_be_restored = is_action && leaf.type.restore != nullptr,
                  .answers_late = is_action && plugin.answers_late,
                  .opens_entries = (leaf.type.flags & LOCKSTEP_OPENS) != 0,
                  .plugin = plugin.name,
                  .more_parameters = text_or_empty(leaf.type.more_ports),
                  .element_types = leaf.element_types.get(),
                  .origin = &plugin,
                  .leaf = &leaf.type};
}

std::optional<Problem> read_descriptors(const lockstep_plugin& entry, std::size_t exported_size,
                                        Descriptors& descriptors) {
  if (auto refusal = check_handshake(entry, exported_size)) return refusal;
  HostedPlugin& plugin = descriptors.plugin;  // what else there is in it stays
  static_cast<lockstep_plugin&>(plugin) = covered_copy(&entry, entry.struct_size);
  if (auto refusal = describe(plugin)) return refusal;
  if (auto refusal = check_plugin(plugin)) return refusal;
  for (std::uint32_t index = 0; index < plugin.leaf_type_count; ++index) {
    auto leaf = std::make_unique<Descriptors::Leaf>();
    if (auto refusal = read_leaf(plugin.leaf_types[index], plugin.name, *leaf)) {
      return Problem{fmt::format("is malformed: leaf type {} {}", index, refusal->message),
                     std::move(refusal->hint)};
    }
    if (std::ranges::any_of(descriptors.leaves, [&](const auto& other) {
          return other->node_type.id == leaf->type.id;
        })) {
      return Problem{fmt::format("is malformed: leaf type {} has the id '{}', as one before it",
                                 index, leaf->type.id),
                     "give each leaf its own id"};
    }
    if (leaf->type.describe != nullptr) leaf->element_types = described_types(plugin, *leaf);
    leaf->node_type = node_type_of(plugin, *leaf);
    descriptors.leaves.push_back(std::move(leaf));
  }
  return std::nullopt;
}

}  // namespace lockstep::host
