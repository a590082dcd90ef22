// The registered nodes as the table that the host reads.
#pragma once

#include <lockstep/leaf.h>

#include <algorithm>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/lockstep/builtin_manifests.h"
#include "behaviortree_cpp/lockstep/leaf.h"

namespace BT {
struct TestNodeConfig;
}  // namespace BT

namespace BT::lockstep_detail {

class PluginTable {
 public:
  void add(const TreeNodeManifest& manifest, const NodeBuilder& build) {
    const std::string& id = manifest.registration_ID;
    const auto [kept, is_new] = manifests_.emplace(id, manifest);
    if (!is_new) throw BehaviorTreeException("ID [", id, "] is registered already");
    builders_.emplace(id, build);
    add_type(kept->second, build);
  }
  // One that trees are rewritten to use: it is not listed.
  void add_unlisted(const TreeNodeManifest& manifest, const NodeBuilder& build) {
    if (types_.count(manifest.registration_ID) != 0) return;
    add_type(unlisted_.emplace(manifest.registration_ID, manifest).first->second, build);
  }
  // False: there is no such type. Trees that have its nodes keep them.
  bool remove(const std::string& id) {
    builders_.erase(id);
    const auto type = types_.find(id);
    if (type == types_.end()) return false;
    removed_types_.push_back(std::move(type->second));
    types_.erase(type);
    removed_manifests_.push_back(manifests_.extract(id));
    return true;
  }

  // With those of the nodes that every tree has.
  std::unordered_map<std::string, TreeNodeManifest>& manifests() {
    if (!std::exchange(has_builtin_, true)) add_builtin_manifests(manifests_);
    return manifests_;
  }
  // Null: there is none.
  const TreeNodeManifest* manifest(const std::string& id) {
    const auto found = manifests().find(id);
    return found == manifests_.end() ? nullptr : &found->second;
  }
  const std::unordered_map<std::string, NodeBuilder>& builders() const { return builders_; }

  const Registration* find(const std::string& id) const {
    const auto found = types_.find(id);
    return found == types_.end() ? nullptr : found->second.get();
  }

  // A word that scripts and ports of enums know as a number. Throws when it has another one.
  void add_word(const std::string& word, int number) {
    const auto [found, is_new] = words_->emplace(word, number);
    if (!is_new && found->second != number) {
      throw LogicError("the word [", word, "] is registered with another number already");
    }
  }
  const std::shared_ptr<ScriptingEnumsRegistry>& words() const { return words_; }

  const std::shared_ptr<PolymorphicCastRegistry>& casts() const { return casts_; }

  // In a program: how its nodes are numbered, by their paths, and those that were made.
  std::map<std::string, NodeNumber> numbers;
  std::map<std::string, TreeNode*> made;
  // The configurations of its TestNodes, by the path that the library gives them.
  std::map<std::string, std::shared_ptr<TestNodeConfig>> tests;

  // The words as the host reads them; valid until one is added.
  const lockstep_words* described_words() {
    word_list_.clear();
    word_numbers_.clear();
    for (const auto& [word, number] : *words_) {
      word_list_.push_back(word.c_str());
      word_numbers_.push_back(number);
    }
    word_table_ = {sizeof word_table_, static_cast<std::uint32_t>(word_list_.size()),
                   word_list_.data(), word_numbers_.data()};
    return &word_table_;
  }

  // The table, valid as long as this; `name` is that of the plugin.
  const lockstep_plugin& describe(std::string name,
                                  decltype(lockstep_plugin::get_extension) get_extension) {
    name_ = std::move(name);
    listed_.clear();
    for (auto& [id, registration] : types_) {
      describe(*registration);
      listed_.push_back(&registration->type);
    }
    plugin_ = {};
    plugin_.abi_major = LOCKSTEP_ABI_MAJOR;
    plugin_.abi_minor = LOCKSTEP_ABI_MINOR;
    plugin_.struct_size = sizeof plugin_;
    plugin_.name = name_.c_str();
    plugin_.doc = "Nodes written for BehaviorTree.CPP";
    plugin_.leaf_type_count = static_cast<std::uint32_t>(listed_.size());
    plugin_.leaf_types = listed_.data();
    plugin_.get_extension = get_extension;
    return plugin_;
  }

 private:
  void add_type(const TreeNodeManifest& manifest, const NodeBuilder& build) {
    auto registration = std::make_unique<Registration>();
    registration->manifest = &manifest;
    registration->build = build;
    types_.emplace(manifest.registration_ID, std::move(registration));
  }

  static const char* keep(Registration& registration, std::string text) {
    return registration.texts.emplace_back(std::move(text)).c_str();
  }

  static void describe(Registration& registration) {
    if (registration.type.struct_size != 0) return;
    const TreeNodeManifest& manifest = *registration.manifest;
    registration.ports.clear();
    for (const auto& [name, info] : manifest.ports) registration.ports.push_back({name, info, 0});
    std::sort(registration.ports.begin(), registration.ports.end(),
              [](const PortEntry& a, const PortEntry& b) { return a.name < b.name; });
    for (PortEntry& port : registration.ports) {
      port.index = static_cast<std::uint32_t>(registration.listed.size());
      registration.listed.push_back(
          &registration.described.emplace_back(described_port(registration, port)));
    }
    lockstep_leaf_type& type = registration.type;
    type.struct_size = sizeof type;
    type.kind = kind_of(manifest.type);
    type.id = manifest.registration_ID.c_str();
    for (const auto& [key, value] : manifest.metadata) {
      if (key == "description") type.doc = keep(registration, value);
    }
    type.port_count = static_cast<std::uint32_t>(registration.listed.size());
    type.ports = registration.listed.data();
    type.create = Leaf::create;
    type.destroy = Leaf::destroy;
    const bool is_short =
        manifest.lockstep_hooks.is_at_once || manifest.type == NodeType::CONDITION;
    if (!is_short) type.start = Leaf::start;
    type.start_unreset = is_short ? Leaf::start_unreset_at_once : Leaf::start_unreset;
    type.tick = is_short ? Leaf::tick_at_once : Leaf::tick;
    if (manifest.lockstep_hooks.reason != nullptr) {
      type.tick =
          is_short ? Leaf::tick_and_say<Leaf::tick_at_once> : Leaf::tick_and_say<Leaf::tick>;
    }
    type.halt = Leaf::halt;
    if (manifest.lockstep_hooks.pause != nullptr) type.pause = Leaf::pause;
    if (manifest.lockstep_hooks.resume != nullptr) type.resume = Leaf::resume;
    if (manifest.lockstep_hooks.progress != nullptr) type.progress = Leaf::progress;
    if (manifest.lockstep_hooks.pace != nullptr) type.set_pace = Leaf::set_pace;
    if (manifest.lockstep_hooks.save != nullptr) {
      type.save = Leaf::save;
      type.restore = Leaf::restore;
    }
    type.flags = LOCKSTEP_HALTS_CHILDREN | LOCKSTEP_WAKES;
    if (manifest.type == NodeType::CONDITION) type.flags |= LOCKSTEP_MAY_RUN;
    if (manifest.lockstep_hooks.is_at_once) type.flags |= LOCKSTEP_AT_ONCE;
    if (opens_entries()) type.flags |= LOCKSTEP_OPENS;
  }

  static lockstep_leaf_kind kind_of(NodeType type) {
    switch (type) {
      case NodeType::CONDITION:
        return LOCKSTEP_CONDITION;
      case NodeType::CONTROL:
        return LOCKSTEP_CONTROL;
      case NodeType::DECORATOR:
      case NodeType::SUBTREE:
        return LOCKSTEP_DECORATOR;
      default:
        return LOCKSTEP_ACTION;
    }
  }

  static lockstep_port described_port(Registration& registration, const PortEntry& entry) {
    constexpr lockstep_direction kDirections[] = {LOCKSTEP_INPUT, LOCKSTEP_OUTPUT, LOCKSTEP_INOUT};
    const PortInfo& info = entry.info;
    lockstep_port port{};
    port.struct_size = sizeof port;
    port.type = info.lockstep_values().type;
    port.direction = kDirections[static_cast<int>(info.direction())];
    port.name = entry.name.c_str();
    port.doc = keep(registration, info.description());
    port.object = info.lockstep_values().object();
    port.flags = LOCKSTEP_OPTIONAL;
    describe_default(registration, info, port);
    return port;
  }

  // A default that the host cannot read is taken by getInput.
  static void describe_default(Registration& registration, const PortInfo& info,
                               lockstep_port& port) {
    const std::string& text = info.defaultValueString();
    if (text == "=" || TreeNode::isBlackboardPointer(text)) {
      port.default_value = keep(registration, text == "=" ? "{=}" : text);
      port.flags |= LOCKSTEP_DEFAULT_ENTRY;
    } else if (port.type != LOCKSTEP_OBJECT && port.type != LOCKSTEP_ANY &&
               info.defaultValue().isType<std::string>() == (port.type == LOCKSTEP_STRING) &&
               !info.defaultValue().empty() && (!text.empty() || port.type == LOCKSTEP_STRING)) {
      port.default_value = keep(registration, text);
    }
  }

  using Manifests = std::unordered_map<std::string, TreeNodeManifest>;
  Manifests manifests_, unlisted_;
  bool has_builtin_ = false;
  std::unordered_map<std::string, NodeBuilder> builders_;
  std::map<std::string, std::unique_ptr<Registration>> types_;
  // Nodes of trees point to them.
  std::vector<Manifests::node_type> removed_manifests_;
  std::vector<std::unique_ptr<Registration>> removed_types_;
  std::shared_ptr<ScriptingEnumsRegistry> words_ = std::make_shared<ScriptingEnumsRegistry>();
  std::shared_ptr<PolymorphicCastRegistry> casts_ = std::make_shared<PolymorphicCastRegistry>();
  std::vector<const char*> word_list_;
  std::vector<double> word_numbers_;
  lockstep_words word_table_{};
  std::string name_;
  std::vector<const lockstep_leaf_type*> listed_;
  lockstep_plugin plugin_{};
};

// The program whose nodes are being made in this thread. Null: they are those of this plugin.
[[gnu::visibility("hidden")]] inline thread_local PluginTable* making = nullptr;

class Making {
 public:
  explicit Making(PluginTable& table) { making = &table; }
  ~Making() { making = nullptr; }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
};

[[gnu::visibility("hidden")]] PluginTable& made_table();

[[gnu::visibility("hidden")]] inline const void* table_extension(const char* id) {
  const bool is_words = id != nullptr && StringView(id) == LOCKSTEP_WORDS;
  return is_words ? made_table().described_words() : nullptr;
}

}  // namespace BT::lockstep_detail
