#include "leaves/plugin/contract/leaf_set.h"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>
#include <vector>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "base/system/float_mode.h"
#include "leaves/plugin/contract/call_sites.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/host.h"

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

const double* kept_progress_of(const LeafSlot& slot) {
  const lockstep_leaf_type& type = *slot.type;
  if (type.get_extension == nullptr || type.progress == nullptr) return nullptr;
  if (type.kind != LOCKSTEP_ACTION) return nullptr;
  return static_cast<const double*>(type.get_extension(slot.self, LOCKSTEP_KEPT_PROGRESS));
}

const CallSite::Origin& origin_of(const NodeType& type) {
  return CallSite::origin_of({.id = type.id,
                              .plugin = type.plugin,
                              .kind = kind_of(type.category),
                              .is_local = is_local(type)});
}

}  // namespace

struct LeafSet::Implementation {
  // The data of a run that the leaves of a plugin share; the plugin sees it as its run context.
  struct Context {
    const lockstep_plugin* plugin;
    NodeIndex node;  // the first leaf of the plugin
    const CallSite* site;
    CallerRun run;
    LeafSlot slot = {};  // `self` is the context
    std::optional<lockstep_caller> caller = {};
    bool created = false;
  };

  Implementation(const Tree& tree, Blackboard& blackboard, const LeafTime& time, LeafLog log,
                 BoardsOfRun* boards);
  ~Implementation() { destroy_all(); }  // NOLINT(bugprone-exception-escape): plugins' are caught
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // Shared by all leaves of a type.
  struct Type {
    std::size_t context;  // in contexts_
    const CallSite::Origin* origin;
  };
  const Type& know_type(const LeafNode& leaf);
  std::size_t know_context(const NodeType& type, NodeIndex node);
  void add_caller(const LeafNode& leaf, LeafSlot& slot);
  void bind_ports();
  void create_all(std::uint64_t seed);
  void destroy_all();
  bool create_context(Context& context);
  bool create_leaf(std::uint32_t index);
  void destroy_leaf(std::size_t index);
  void destroy_context(const Context& context);
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
  // Plugins keep pointers to callers, and callers to slots: once made, none of them moves.
  std::vector<std::unique_ptr<Context>> contexts_;
  std::vector<LeafSlot> slots_;
  CallerRun run_;
  PortTable ports_;                       // of the leaves
  std::vector<lockstep_caller> callers_;  // of the leaves
  CallSites site_memory_;
  std::unordered_map<const NodeType*, Type> types_;
  std::optional<Fault> fault_;
  bool is_destroyed_ = false;
};

LeafSet::Implementation::Implementation(const Tree& tree, Blackboard& blackboard,
                                        const LeafTime& time, LeafLog log, BoardsOfRun* boards)
    : tree_(tree),
      blackboard_(blackboard),
      time_(time),
      log_(std::move(log)),
      slots_(tree.leaves.size()),
      run_{.log = &log_, .tree = &tree, .boards = boards, .lock = blackboard.lock.get()} {
  if (run_.lock != nullptr) ports_.hide_entries();
  callers_.reserve(tree.leaves.size());
  std::string path;
  for (const LeafNode& leaf : tree.leaves) {
    LeafSlot& slot = slots_[callers_.size()];
    slot.type = leaf.type->leaf;
    tree.path(leaf.node, path);
    slot.site = &site_memory_.add(path, *know_type(leaf).origin);
    add_caller(leaf, slot);
  }
  bind_ports();
}

const LeafSet::Implementation::Type& LeafSet::Implementation::know_type(const LeafNode& leaf) {
  const auto [it, is_new] = types_.try_emplace(leaf.type);
  if (is_new) it->second = {know_context(*leaf.type, leaf.node), &origin_of(*leaf.type)};
  return it->second;
}

std::size_t LeafSet::Implementation::know_context(const NodeType& type, NodeIndex node) {
  const lockstep_plugin* const plugin = type.origin;
  for (std::size_t index = 0; index < contexts_.size(); ++index) {
    if (contexts_[index]->plugin == plugin) return index;
  }
  contexts_.push_back(std::make_unique<Context>(
      Context{.plugin = plugin,
              .node = node,
              .site = &CallSite::of({.plugin = plugin->name, .is_local = is_local(type)}),
              .run = {.log = &log_, .plugin = plugin}}));
  Context& context = *contexts_.back();
  context.caller.emplace(time_, context.slot, context.run).who = plugin->name;
  return contexts_.size() - 1;
}

void LeafSet::Implementation::add_caller(const LeafNode& leaf, LeafSlot& slot) {
  lockstep_caller& caller = callers_.emplace_back(time_, slot, run_);
  caller.who = slot.site->path;
  caller.type = leaf.type;
  caller.node = leaf.node;
  caller.first_child = leaf.first_child;
  caller.children = leaf.children;
}

void LeafSet::Implementation::bind_ports() {
  PortBinder binder(tree_, blackboard_, ports_);
  std::vector<std::size_t> first;
  first.reserve(tree_.leaves.size());
  for (const LeafNode& leaf : tree_.leaves) first.push_back(binder.bind(leaf));
  ports_.shrink();
  for (std::size_t i = 0; i < first.size(); ++i) {
    ports_.give_to(callers_[i], first[i], tree_.leaves[i].type->parameters.size());
  }
}

// In reverse order; what was not created is passed over.
void LeafSet::Implementation::destroy_all() {
  if (std::exchange(is_destroyed_, true)) return;
  for (std::size_t index = slots_.size(); index-- > 0;) {
    LeafSlot& slot = slots_[index];
    if (slot.self != nullptr) destroy_leaf(index);
    slot = LeafSlot{.type = slot.type, .site = slot.site};
  }
  // While what the leaves of a run share is still there.
  const InEngine scope(run_.lock);
  blackboard_.names.forget_objects();
  for (Entry& entry : blackboard_.entries) entry.forget_object();
  for (lockstep_caller& caller : callers_) {
    for (const BoundPort* const port : caller.ports) {
      if (port->memory == nullptr) continue;
      port->memory->packed = port->memory->unpacked = Object();
      port->memory->seen = Value();
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
  const std::string reason = call(callers_[index], *slot.site, PluginFunction::Destroy,
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

bool LeafSet::Implementation::create_context(Context& context) {
  const lockstep_plugin* const plugin = context.plugin;
  if (plugin->create_run == nullptr) return true;
  std::string reason = call(*context.caller, *context.site, PluginFunction::CreateRun, [&] {
    context.slot.self = plugin->create_run(&host_table(), &*context.caller);
    // A context that came with an error must go, too; NULL is a context only without an error.
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
  void* const context = contexts_[types_.at(leaf.type).context]->slot.self;
  std::string reason = call(callers_[index], *slot.site, PluginFunction::Create, [&] {
    slot.self = slot.type->create(&host_table(), &callers_[index], context);
    if (slot.self != nullptr) slot.kept_progress = kept_progress_of(slot);
  });
  if (reason.empty() && slot.error != nullptr) reason = slot.error;
  if (reason.empty() && slot.self == nullptr) reason = "its create returned NULL without an error";
  return reason.empty() || fail(leaf.node, fmt::format("could not be created: {}", reason));
}

void LeafSet::Implementation::create_all(std::uint64_t seed) {
  fault_.reset();
  is_destroyed_ = false;
  CallMark::this_thread().set_tick(CallMark::kNoTick);
  for (std::size_t index = 0; index < contexts_.size(); ++index) {
    contexts_[index]->caller->random = RandomStream(seed, kFirstRunStream + index + 1);
    if (!create_context(*contexts_[index])) return;
  }
  for (std::uint32_t index = 0; index < tree_.leaves.size(); ++index) {
    callers_[index].random = RandomStream(seed, index + std::uint64_t{1});
    if (!create_leaf(index)) return;
  }
}

LeafSet::LeafSet(const Tree& tree, Blackboard& blackboard, const LeafTime& time, std::uint64_t seed,
                 LeafLog log, BoardsOfRun* boards)
    : it_(std::make_unique<Implementation>(tree, blackboard, time, std::move(log), boards)) {
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
void LeafSet::set_node_context(NodeContext& context) {
  it_->run_.node_context = &context;
}
const std::optional<Fault>& LeafSet::fault() const {
  return it_->fault_;
}

}  // namespace lockstep::host
