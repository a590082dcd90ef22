#include "plugin/contract/leaf_set.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "core/plugin_exception.h"
#include "plugin/contract/call_mark.h"
#include "plugin/contract/descriptor.h"
#include "plugin/contract/float_mode.h"
#include "plugin/contract/host.h"
#include "plugin/contract/leaf_watch.h"

namespace lockstep::host {
namespace {

// Run contexts draw from streams that no leaf of any tree can have.
constexpr std::uint64_t kFirstRunStream = std::uint64_t{1} << 32;

// Calls a plugin, which should let no exception out. Returns the reason when it does, else "".
template <class Call>
std::string call_plugin(const CallSite& site, PluginFunction function, Call call) {
  const MarkedCall marked(site, function);
  return thrown_by(call);
}

const char* kind_of(NodeCategory category) {
  if (category == NodeCategory::Control) return CallSite::kControlNode;
  return category == NodeCategory::Decorator ? CallSite::kDecorator : CallSite::kLeaf;
}

bool is_local(const NodeType& type) {
  return static_cast<const HostedPlugin*>(type.origin)->is_local;
}

const CallSite& site_of(const LeafNode& leaf, std::string_view path) {
  return CallSite::of({.path = path,
                       .id = leaf.type->id,
                       .plugin = leaf.type->plugin,
                       .kind = kind_of(leaf.type->category),
                       .is_local = is_local(*leaf.type)});
}

}  // namespace

std::vector<BoundPort> bind_ports(const Tree& tree, const LeafNode& leaf, Blackboard& blackboard) {
  std::vector<BoundPort> ports;
  ports.reserve(leaf.type->parameters.size());
  for (std::size_t index = 0; index < leaf.type->parameters.size(); ++index) {
    const PortBinding& binding = tree.ports[leaf.first_port + index];
    const Parameter& parameter = leaf.type->parameters[index];
    BoundPort port{.type = parameter.type,
                   .limits = limits_of(parameter),
                   .object = parameter.object,
                   .is_generic = parameter.is_generic,
                   .direction = parameter.direction,
                   .name = parameter.name};
    const Value* const constant =
        binding.constant != PortBinding::kUnbound ? &tree.constants[binding.constant] : nullptr;
    if (binding.slot != PortBinding::kUnbound) {
      Entry& entry = blackboard.entries[binding.slot];
      port.read = &entry.value;
      port.is_strict = tree.slots[binding.slot].typing == Typing::Strict;
      if (parameter.direction != Direction::Input) port.write = &entry;
      port.fallback = constant;
      port.entry = tree.slots[binding.slot].name;
    } else {
      port.read = constant;
    }
    ports.push_back(std::move(port));
  }
  return ports;
}

// What lockstep_place knows of it.
void name_place(const Tree& tree, const LeafNode& leaf, lockstep_caller& caller) {
  caller.node = leaf.node;
  caller.name = tree.labels[leaf.node].name;
  caller.id = leaf.type->leaf->id;
  caller.plugin_name = leaf.type->plugin;
  caller.opens_entries = leaf.type->opens_entries && !tree.boards.empty();
  for (const NodeIndex child : children_of(tree, leaf)) {
    const NodeLabel& label = tree.labels[child];
    caller.labels.push_back({std::string(label.type->id), std::string(label.name)});
  }
}

std::span<const NodeIndex> children_of(const Tree& tree, const LeafNode& node) {
  return std::span(tree.children).subspan(node.first_child, node.children);
}

struct LeafSet::Implementation {
  // What a run shares per plugin; seen by the plugin as its run context.
  struct Context {
    const lockstep_plugin* plugin;
    NodeIndex node;  // the first leaf of the plugin
    const CallSite* site;
    LeafSlot slot = {};  // `self` is the context
    std::unique_ptr<lockstep_caller> caller = {};
    bool created = false;
  };

  Implementation(const Tree& tree, Blackboard& blackboard, const LeafTime& time, LeafLog log,
                 LeafWatch* watch);
  ~Implementation() { destroy_all(); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void create_all(std::uint64_t seed);
  void destroy_all();
  bool create_context(Context& context);
  bool create_leaf(std::uint32_t index);
  void destroy_leaf(std::size_t index);
  void destroy_context(const Context& context);
  Context* find_context(const void* plugin);
  lockstep_caller make_caller(std::string_view who, LeafSlot& slot);
  bool fail(NodeIndex node, std::string message);
  void warn(const lockstep_caller& caller, const std::string& message);
  // Calls a function that is not called while ticking. Returns why it failed, or "".
  template <class Call>
  std::string call(const lockstep_caller& caller, const CallSite& site, PluginFunction function,
                   Call call);

  const Tree& tree_;
  Blackboard& blackboard_;
  const LeafTime& time_;
  LeafLog log_;
  LeafWatch* const watch_;
  // Plugins keep pointers to callers, and callers to slots: once made, none of them moves.
  std::vector<std::unique_ptr<Context>> contexts_;
  std::vector<LeafSlot> slots_;
  std::vector<lockstep_caller> callers_;  // of the leaves
  std::vector<const CallSite*> sites_;    // of the leaves
  std::optional<Fault> fault_;
  bool is_destroyed_ = false;
};

LeafSet::Implementation::Implementation(const Tree& tree, Blackboard& blackboard,
                                        const LeafTime& time, LeafLog log, LeafWatch* watch)
    : tree_(tree),
      blackboard_(blackboard),
      time_(time),
      log_(std::move(log)),
      watch_(watch),
      slots_(tree.leaves.size()) {
  callers_.reserve(tree.leaves.size());
  sites_.reserve(tree.leaves.size());
  std::string path;
  for (const LeafNode& leaf : tree.leaves) {
    if (find_context(leaf.type->origin) == nullptr) {
      const lockstep_plugin* const plugin = leaf.type->origin;
      contexts_.push_back(std::make_unique<Context>(Context{
          .plugin = plugin,
          .node = leaf.node,
          .site = &CallSite::of({.plugin = plugin->name, .is_local = is_local(*leaf.type)})}));
      Context& context = *contexts_.back();
      context.caller = std::make_unique<lockstep_caller>(make_caller(plugin->name, context.slot));
      context.caller->plugin = plugin;
    }
    LeafSlot& slot = slots_[callers_.size()];
    slot.type = leaf.type->leaf;
    tree.path(leaf.node, path);
    const CallSite& site = site_of(leaf, path);
    sites_.push_back(&site);
    lockstep_caller& caller = callers_.emplace_back(make_caller(site.path, slot));
    caller.site = &site;
    caller.children = children_of(tree, leaf);
    caller.ports = bind_ports(tree, leaf, blackboard);
    name_place(tree, leaf, caller);
  }
}

// In reverse order; what was not created is passed over.
void LeafSet::Implementation::destroy_all() {
  if (std::exchange(is_destroyed_, true)) return;
  if (watch_ != nullptr) watch_->remove(slots_);
  for (std::size_t index = slots_.size(); index-- > 0;) {
    LeafSlot& slot = slots_[index];
    if (slot.self != nullptr) destroy_leaf(index);
    slot = LeafSlot{.type = slot.type};
  }
  // While what the leaves of a run share is still there.
  for (Entry& entry : blackboard_.entries) {
    if (std::holds_alternative<Object>(entry.value)) entry.value = NoValue();
  }
  for (lockstep_caller& caller : callers_) {
    for (BoundPort& port : caller.ports) {
      port.packed = port.unpacked = Object();
      const bool is_opened = port.is_generic && port.write != nullptr;
      if (is_opened && std::holds_alternative<Object>(port.write->value)) {
        port.write->value = NoValue();
      }
    }
  }
  for (std::size_t index = contexts_.size(); index-- > 0;) {
    Context& context = *contexts_[index];
    if (context.created) destroy_context(context);
    context.created = false;
    context.slot = {};
  }
}

void LeafSet::Implementation::destroy_leaf(std::size_t index) {
  const LeafSlot& slot = slots_[index];
  const std::string reason = call(callers_[index], *sites_[index], PluginFunction::Destroy,
                                  [&] { slot.type->destroy(slot.self); });
  if (!reason.empty()) warn(callers_[index], "its destroy " + reason);
}

void LeafSet::Implementation::destroy_context(const Context& context) {
  const std::string reason = call(*context.caller, *context.site, PluginFunction::DestroyRun,
                                  [&] { context.plugin->destroy_run(context.slot.self); });
  if (!reason.empty()) warn(*context.caller, "its destroy_run " + reason);
}

void LeafSet::Implementation::warn(const lockstep_caller& caller, const std::string& message) {
  host_table().log(&caller, LOCKSTEP_LOG_WARNING, message.c_str());
}

template <class Call>
std::string LeafSet::Implementation::call(const lockstep_caller& caller, const CallSite& site,
                                          PluginFunction function, Call call) {
  const FloatMode mode = FloatMode::current();
  std::string reason = call_plugin(site, function, call);
  if (FloatMode::current() != mode) {
    mode.restore();
    warn(caller, fmt::format("its {} has changed the rounding mode or the floating-point "
                             "exceptions; they were restored",
                             name_of(function)));
  }
  return reason;
}

bool LeafSet::Implementation::fail(NodeIndex node, std::string message) {
  fault_ = Fault{node, std::move(message)};
  return false;
}

LeafSet::Implementation::Context* LeafSet::Implementation::find_context(const void* plugin) {
  for (const auto& context : contexts_) {
    if (context->plugin == plugin) return context.get();
  }
  return nullptr;
}

lockstep_caller LeafSet::Implementation::make_caller(std::string_view who, LeafSlot& slot) {
  return {.who = who,
          .ports = {},
          .random = RandomStream(0, 0),
          .time = &time_,
          .log = &log_,
          .slot = &slot};
}

bool LeafSet::Implementation::create_context(Context& context) {
  const lockstep_plugin* const plugin = context.plugin;
  if (plugin->create_run == nullptr) return true;
  std::string reason = call(*context.caller, *context.site, PluginFunction::CreateRun, [&] {
    context.slot.self = plugin->create_run(&host_table(), context.caller.get());
    // What came with an error is a context that must go; NULL is one only without an error.
    context.created = context.slot.self != nullptr || context.slot.error == nullptr;
  });
  if (reason.empty() && context.slot.error != nullptr) reason = context.slot.error;
  if (reason.empty()) return true;
  return fail(context.node, fmt::format("the run context of plugin '{}' could not be created: {}",
                                        plugin->name, reason));
}

bool LeafSet::Implementation::create_leaf(std::uint32_t index) {
  const LeafNode& leaf = tree_.leaves[index];
  LeafSlot& slot = slots_[index];
  void* const context = find_context(leaf.type->origin)->slot.self;
  std::string reason = call(callers_[index], *sites_[index], PluginFunction::Create, [&] {
    slot.self = slot.type->create(&host_table(), &callers_[index], context);
  });
  if (reason.empty() && slot.error != nullptr) reason = slot.error;
  if (reason.empty() && slot.self == nullptr) reason = "its create returned NULL without an error";
  return reason.empty() || fail(leaf.node, fmt::format("could not be created: {}", reason));
}

void LeafSet::Implementation::create_all(std::uint64_t seed) {
  fault_.reset();
  is_destroyed_ = false;
  for (std::size_t index = 0; index < contexts_.size(); ++index) {
    contexts_[index]->caller->random = RandomStream(seed, kFirstRunStream + index + 1);
    if (!create_context(*contexts_[index])) return;
  }
  for (std::uint32_t index = 0; index < tree_.leaves.size(); ++index) {
    callers_[index].random = RandomStream(seed, index + std::uint64_t{1});
    if (!create_leaf(index)) return;
  }
  if (watch_ != nullptr) watch_->insert(tree_, slots_, sites_);
}

LeafSet::LeafSet(const Tree& tree, Blackboard& blackboard, const LeafTime& time, std::uint64_t seed,
                 LeafLog log, LeafWatch* watch)
    : it_(std::make_unique<Implementation>(tree, blackboard, time, std::move(log), watch)) {
  create_all(seed);
}

LeafSet::~LeafSet() = default;

void LeafSet::destroy_all() {
  it_->destroy_all();
}
void LeafSet::create_all(std::uint64_t seed) {
  it_->create_all(seed);
}
std::span<LeafSlot> LeafSet::slots() {
  return it_->slots_;
}
void LeafSet::set_ticker(Ticker& ticker) {
  for (lockstep_caller& caller : it_->callers_) caller.ticker = &ticker;
}
const std::optional<Fault>& LeafSet::fault() const {
  return it_->fault_;
}

}  // namespace lockstep::host
