// The functions of the contract for all nodes of a plugin.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/lockstep/registration.h"

namespace BT::lockstep_detail {

// The type of that id; null: none.
[[gnu::visibility("hidden")]] const Registration* find_registration(const std::string& id);
[[gnu::visibility("hidden")]] const std::shared_ptr<ScriptingEnumsRegistry>& registered_enums();
[[gnu::visibility("hidden")]] const std::shared_ptr<PolymorphicCastRegistry>& registered_casts();
// In a program: what the library calls the node, null otherwise; a node that was made there.
[[gnu::visibility("hidden")]] const NodeNumber* number_of(const std::string& path);
[[gnu::visibility("hidden")]] void note_made(const std::string& path, TreeNode& node);

struct Leaf {
  Place place;
  std::unique_ptr<TreeNode> node;
  NodeStatus last = NodeStatus::IDLE;  // of tick_at_once
  bool is_unreset = false;             // its parent has not reset it

  static void* create(const lockstep_host* host, const lockstep_caller* id, void* /*context*/) {
    return lockstep::detail::guarded({host, id}, static_cast<void*>(nullptr), [&]() -> void* {
      auto leaf = std::make_unique<Leaf>();
      leaf->make(*host, id);
      return leaf.release();
    });
  }
  static void destroy(void* self) {
    const std::unique_ptr<Leaf> leaf(static_cast<Leaf*>(self));
    lockstep::detail::guarded_end(leaf->caller(), [&] { leaf->node.reset(); });
  }
  static void start(void* self) { static_cast<Leaf*>(self)->node->lockstep_forget_status(); }
  // The node's parent has not reset it: it has the status that it had.
  static void start_unreset(void* /*self*/) {}
  static lockstep_status tick(void* self) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    return leaf.result_of(*leaf.node);
  }
  // For a node that is mostly done in one tick, and so is not told of the first one.
  static lockstep_status tick_at_once(void* self) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    if (leaf.node->lockstep_tree_ != nullptr) return tick_in_program(leaf);
    const lockstep_status status = leaf.result_of(*leaf.node);
    leaf.last = static_cast<NodeStatus>(status);
    if (status == LOCKSTEP_RUNNING) return status;
    if (leaf.node->lockstep_watch_ != nullptr) return tell_end(leaf, status);
    leaf.node->lockstep_status_.store(NodeStatus::IDLE, std::memory_order_release);
    return status;
  }
  // Of a class with `std::string reason() const`: why it has failed, or what it waits for.
  template <lockstep_status (*Tick)(void*)>
  static lockstep_status tick_and_say(void* self) {
    const lockstep_status status = Tick(self);
    Leaf& leaf = *static_cast<Leaf*>(self);
    const auto* const table =
        static_cast<const lockstep_reason*>(leaf.place.host->get_extension(LOCKSTEP_REASON));
    if (table == nullptr || (status != LOCKSTEP_FAILURE && status != LOCKSTEP_RUNNING))
      return status;
    leaf.call([&leaf, table](const TreeNode& node, const ClassHooks& it) {
      it.reason(node, *table, leaf.place.caller);
    });
    return status;
  }
  static void start_unreset_at_once(void* self) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    leaf.is_unreset = true;
    leaf.node->lockstep_status_.store(leaf.last, std::memory_order_release);  // it has not changed
  }
  static void halt(void* self) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    leaf.call([&leaf](TreeNode& node, const ClassHooks&) {
      const InTick scope(leaf.place);  // its children may be halted
      node.haltNode();
    });
  }
  static void pause(void* self) {
    static_cast<Leaf*>(self)->call([](TreeNode& node, const ClassHooks& it) { it.pause(node); });
  }
  static void resume(void* self) {
    static_cast<Leaf*>(self)->call([](TreeNode& node, const ClassHooks& it) { it.resume(node); });
  }
  static double set_pace(void* self, double factor) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    return lockstep::detail::guarded(leaf.caller(), 1.0,
                                     [&] { return leaf.hooks().pace(*leaf.node, factor); });
  }
  static std::size_t save(void* self, void* bytes, std::size_t room) {
    const Leaf& leaf = *static_cast<const Leaf*>(self);
    return lockstep::detail::guarded(leaf.caller(), std::size_t{0}, [&] {
      const std::string kept = leaf.hooks().save(*leaf.node);
      if (kept.size() <= room) std::memcpy(bytes, kept.data(), kept.size());
      return kept.size();
    });
  }
  // One that continues is RUNNING, so that its next tick is no first one. onRestored does not learn
  // that it is held, so it is paused again.
  static lockstep_after_cut restore(void* self, const void* bytes, std::size_t size,
                                    const lockstep_cut* cut) {
    Leaf& leaf = *static_cast<Leaf*>(self);
    return lockstep::detail::guarded(leaf.caller(), LOCKSTEP_STARTS_AGAIN + 0, [&] {
      const std::string kept(static_cast<const char*>(bytes), size);
      if (!leaf.hooks().restore(*leaf.node, kept)) return LOCKSTEP_STARTS_AGAIN + 0;
      leaf.node->setStatus(NodeStatus::RUNNING);
      if (cut->held && leaf.hooks().pause != nullptr) leaf.hooks().pause(*leaf.node);
      return LOCKSTEP_CONTINUES + 0;
    });
  }
  static double progress(void* self) {
    const Leaf& leaf = *static_cast<const Leaf*>(self);
    return lockstep::detail::guarded(leaf.caller(), 0.0,
                                     [&] { return leaf.hooks().progress(*leaf.node); });
  }

 private:
  [[gnu::always_inline]] lockstep_status result_of(TreeNode& its_node) {
    try {
      const InTick scope(place);
      return static_cast<lockstep_status>(its_node.executeTick());
    } catch (...) {
      fail();
      return LOCKSTEP_FAILURE;
    }
  }
  [[gnu::noinline]] static lockstep_status tell_end(Leaf& leaf, lockstep_status status) {
    leaf.node->setStatus(NodeStatus::IDLE);
    return status;
  }
  // A program may look at the result until the next tick.
  [[gnu::noinline]] static lockstep_status tick_in_program(Leaf& leaf) {
    if (!std::exchange(leaf.is_unreset, false) &&
        isStatusCompleted(leaf.node->lockstep_status_.load(std::memory_order_relaxed))) {
      leaf.node->setStatus(NodeStatus::IDLE);
    }
    const lockstep_status status = leaf.result_of(*leaf.node);
    leaf.last = static_cast<NodeStatus>(status);
    return status;
  }

  // Marks a tick.
  class InTick {
   public:
    [[gnu::always_inline]] explicit InTick(Place& place) : place_(place) {
      place_.ticking.store(this_thread(), std::memory_order_relaxed);
    }
    [[gnu::always_inline]] ~InTick() { place_.ticking.store({}, std::memory_order_relaxed); }
    InTick(const InTick&) = delete;
    InTick& operator=(const InTick&) = delete;

   private:
    Place& place_;
  };

  // In a catch: what was thrown is an error of the node. Out of line, so that a tick stays small.
  [[gnu::cold, gnu::noinline]] void fail() const {
    lockstep::detail::guarded(caller(), false, []() -> bool { throw; });
  }

  lockstep::detail::Caller caller() const { return {place.host, place.caller}; }
  const ClassHooks& hooks() const { return place.registration->manifest->lockstep_hooks; }

  template <class Call>
  void call(Call function) {
    lockstep::detail::guarded(caller(), true, [&] {
      function(*node, hooks());
      return true;
    });
  }

  void make(const lockstep_host& host, const lockstep_caller* id) {
    place.host = &host;
    place.caller = id;
    place.node = static_cast<const lockstep_place*>(host.get_extension(LOCKSTEP_PLACE));
    if (place.node == nullptr) throw RuntimeError("this lockstep is too old for the plugin");
    place.registration = find_registration(place.node->id(id));
    find_constants();
    const NodeConfig config = make_config();
    creating = &place;
    try {
      node = place.registration->build(place.node->name(id), config);
    } catch (...) {
      creating = nullptr;
      throw;
    }
    creating = nullptr;
    if (node == nullptr) throw RuntimeError("its builder returned no node");
    node->lockstep_place_ = &place;
    lockstep_find_children(host);
    const NodeNumber* const number = number_of(place.node->path(id));
    node->lockstep_registration_name_ = number != nullptr && number->is_read
                                            ? number->id
                                            : place.registration->manifest->registration_ID;
    note_made(place.node->path(id), *node);
  }

  void find_constants() {
    const void* const found = place.host->get_extension(LOCKSTEP_LASTING);
    const auto* const lasting = static_cast<const lockstep_lasting*>(found);
    const std::vector<PortEntry>& ports = place.registration->ports;
    if (lasting == nullptr || ports.empty()) return;
    place.constants = std::make_unique<const void*[]>(ports.size());
    for (const PortEntry& port : ports) {
      const lockstep_type type = port.info.lockstep_values().type;
      place.constants[port.index] = lasting->constant(place.caller, port.index, type);
    }
  }

  void lockstep_find_children(const lockstep_host& host) {
    if (node->type() == NodeType::ACTION || node->type() == NodeType::CONDITION) return;
    place.children = static_cast<const lockstep_children*>(host.get_extension(LOCKSTEP_CHILDREN));
    if (place.children == nullptr) throw RuntimeError("this lockstep has no control nodes");
    node->lockstep_find_children(place);
  }

  // In a program, an entry has the C++ type of the first port that names it.
  void declare_entries() const {
    for (const PortEntry& port : place.registration->ports) {
      const auto entry = Blackboard::lockstep_of_port(place, port.index);
      if (entry.board != nullptr) entry.board->lockstep_declare(entry.key, port.info);
    }
  }

  NodeConfig make_config() {
    NodeConfig config;
    config.blackboard = Blackboard::lockstep_at(place);
    config.blackboard->setPolymorphicCastRegistry(registered_casts());
    config.enums = registered_enums();
    config.manifest = place.registration->manifest;
    config.path = place.node->path(place.caller);
    if (const NodeNumber* const number = number_of(config.path)) {
      config.path = number->path;
      config.uid = number->uid;
      declare_entries();
      if (number->is_read) {
        config.manifest = number->manifest;
        config.input_ports = number->input_ports;
        config.output_ports = number->output_ports;
        config.other_attributes = number->other_attributes;
        return config;
      }
    }
    for (const PortEntry& port : place.registration->ports) {
      const char* const given = place.node->given(place.caller, port.index);
      if (given == nullptr) continue;
      const PortDirection direction = port.info.direction();
      if (direction != PortDirection::OUTPUT) config.input_ports[port.name] = given;
      if (direction != PortDirection::INPUT) config.output_ports[port.name] = given;
    }
    return config;
  }
};

}  // namespace BT::lockstep_detail
