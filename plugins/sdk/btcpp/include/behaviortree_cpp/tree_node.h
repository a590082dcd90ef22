// A node, as its own class sees it.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/lockstep/node_tree.h"
#include "behaviortree_cpp/lockstep/registration.h"
#include "behaviortree_cpp/utils/signal.h"
#include "behaviortree_cpp/utils/wakeup_signal.hpp"

namespace BT {
namespace lockstep_detail {
class Program;
class TreeWatch;
}  // namespace lockstep_detail

struct TreeNodeManifest {
  NodeType type = NodeType::UNDEFINED;
  std::string registration_ID;
  PortsList ports;
  KeyValueVector metadata;
  lockstep_detail::ClassHooks lockstep_hooks = {};
};

using PortsRemapping = std::unordered_map<std::string, std::string>;
using NonPortAttributes = std::unordered_map<std::string, std::string>;
using ScriptingEnumsRegistry = std::unordered_map<std::string, int>;

enum class PreCond { FAILURE_IF = 0, SUCCESS_IF, SKIP_IF, WHILE_TRUE, COUNT_ };
enum class PostCond { ON_HALTED = 0, ON_FAILURE, ON_SUCCESS, ALWAYS, COUNT_ };

inline const std::array<std::string, 4> PreCondNames = {"_failureIf", "_successIf", "_skipIf",
                                                        "_while"};
inline const std::array<std::string, 4> PostCondNames = {"_onHalted", "_onFailure", "_onSuccess",
                                                         "_post"};
template <>
[[nodiscard]] inline std::string toStr<PreCond>(const PreCond& condition) {
  return PreCondNames[static_cast<std::size_t>(condition)];
}
template <>
[[nodiscard]] inline std::string toStr<PostCond>(const PostCond& condition) {
  return PostCondNames[static_cast<std::size_t>(condition)];
}

struct NodeConfig {
  Blackboard::Ptr blackboard;
  std::shared_ptr<ScriptingEnumsRegistry> enums;
  // The tree gives each port a text or "{entry}".
  PortsRemapping input_ports;
  PortsRemapping output_ports;
  NonPortAttributes other_attributes;
  const TreeNodeManifest* manifest = nullptr;
  std::uint16_t uid = 0;
  std::string path;

  // For a node that a program makes: lockstep keeps those of a tree for itself.
  std::map<PreCond, std::string> pre_conditions;
  std::map<PostCond, std::string> post_conditions;
};
using NodeConfiguration = NodeConfig;

template <class T>
constexpr bool hasNodeNameCtor() {
  return std::is_constructible_v<T, const std::string&>;
}
template <class T, class... Arguments>
constexpr bool hasNodeFullCtor() {
  return std::is_constructible_v<T, const std::string&, const NodeConfig&, Arguments...>;
}

class TreeNode {
 public:
  using Ptr = std::shared_ptr<TreeNode>;

  // Calls around a tick. One that returns SUCCESS or FAILURE before it decides in place of tick().
  using PreTickCallback = std::function<NodeStatus(TreeNode&)>;
  using PostTickCallback = std::function<NodeStatus(TreeNode&, NodeStatus)>;
  using TickMonitorCallback = std::function<void(TreeNode&, NodeStatus, std::chrono::microseconds)>;
  void setPreTickFunction(PreTickCallback call);
  void setPostTickFunction(PostTickCallback call);
  void setTickMonitorCallback(TickMonitorCallback call);

  // Calls for each change of the status, as long as the subscriber lives.
  using StatusChangeSignal = Signal<TimePoint, const TreeNode&, NodeStatus, NodeStatus>;
  using StatusChangeSubscriber = StatusChangeSignal::Subscriber;
  using StatusChangeCallback = StatusChangeSignal::CallableFunction;
  [[nodiscard]] StatusChangeSubscriber subscribeToStatusChange(StatusChangeCallback call);

  TreeNode(std::string name, NodeConfig config);
  virtual ~TreeNode();
  TreeNode(const TreeNode&) = delete;
  TreeNode& operator=(const TreeNode&) = delete;

  // One tick with what belongs to it. A control node calls it on its children.
  virtual NodeStatus executeTick();
  void haltNode() {
    if (lockstep_tree_ != nullptr && lockstep_tree_->halt(*this)) return;
    halt();
    resetStatus();
  }

  virtual NodeType type() const = 0;
  NodeStatus status() const {
    const NodeStatus status = lockstep_shown_status();
    if (lockstep_tree_ == nullptr || !isStatusCompleted(status)) return status;
    return lockstep_tree_->is_over(*this) ? NodeStatus::IDLE : status;
  }
  // Null: it is in no tree of a program.
  lockstep_detail::NodeTree* lockstep_tree() const { return lockstep_tree_; }
  bool isHalted() const { return status() == NodeStatus::IDLE; }
  const std::string& name() const { return lockstep_name_; }
  const std::string& fullPath() const { return lockstep_config_.path; }
  const std::string& registrationName() const { return lockstep_registration_name_; }
  std::uint16_t UID() const { return lockstep_config_.uid; }
  const NodeConfig& config() const { return lockstep_config_; }

  // The value of an input, or why there is none.
  template <class T>
  [[nodiscard, gnu::always_inline]] Expected<T> getInput(StringView port) const;
  // The same; `value` stays as it is if there is none.
  template <class T>
  [[gnu::always_inline]] Result getInput(StringView port, T& value) const;
  // Sets an output; an error when the tree gives it no entry, or the entry does not take the value.
  template <class T>
  Result setOutput(StringView port, const T& value);
  // The same as getInput, with how often the entry was written, and when.
  template <class T>
  Expected<Timestamp> getInputStamped(StringView port, T& value) const;
  template <class T>
  Expected<StampedValue<T>> getInputStamped(StringView port) const;

  // The value of the port's entry, which may be changed in place; false when it has no entry.
  template <class Name = std::string>
  [[nodiscard]] AnyPtrLocked getLockedPortContent(const Name& port) {
    lockstep_detail::note_opening<Name>();
    return lockstep_locked_port(port);
  }

  // As the tree has it.
  StringView getRawPortValue(const std::string& port) const;

  static bool isBlackboardPointer(StringView text, StringView* stripped = nullptr);
  static StringView stripBlackboardPointer(StringView text);
  static Expected<StringView> getRemappedKey(StringView port, StringView given);

  // In a tick: the tree is ticked once more in this period, if it runs then. Else, in any thread:
  // who waits for the next period ticks it at once.
  void emitWakeUpSignal();
  // False: nobody would tick it once more, so it does all of its work in one tick.
  bool requiresWakeUp() const { return lockstep_place_ != nullptr || lockstep_wake_up_ != nullptr; }

  // Calls it for the node and all below it, each with its depth.
  virtual void lockstep_visit(const std::function<void(TreeNode*, std::size_t)>& visitor,
                              std::size_t depth);

  // A node of class T, with the constructor that it has.
  template <class T, class... Arguments>
  static std::unique_ptr<TreeNode> Instantiate(const std::string& name, const NodeConfig& config,
                                               Arguments... arguments);

 protected:
  // Around a thread that runs tick(): what getInput gives in it, and what setOutput sets.
  void lockstep_begin_thread();
  void lockstep_end_thread();

  virtual NodeStatus tick() = 0;
  virtual void halt() = 0;
  [[gnu::always_inline]] void setStatus(NodeStatus status) {
    if (lockstep_watch_ != nullptr) return lockstep_tell(status);
    lockstep_status_.store(status, std::memory_order_release);
  }
  // A text as a value of a port: of an enum also a word that is registered, or a number.
  template <class T>
  T parseString(const std::string& text) const;
  void resetStatus() { lockstep_forget_status(); }
  NodeConfig& config() { return lockstep_config_; }
  void setRegistrationID(StringView id) { lockstep_registration_name_ = id; }
  // For a node that a program makes by hand: what emitWakeUpSignal() tells.
  void setWakeUpInstance(std::shared_ptr<WakeUpSignal> signal) {
    lockstep_wake_up_ = std::move(signal);
  }
  // A tick, and what belongs to it; `work` returns the result.
  template <class Work>
  [[gnu::always_inline]] NodeStatus lockstep_tick_as(Work work);
  // Its parts: all but the status, which a thread may set; and the status.
  template <class Work>
  [[gnu::always_inline]] NodeStatus lockstep_result_of(Work work);
  void lockstep_note(NodeStatus status);
  // Notes a result that is rare or watched, and returns it.
  NodeStatus lockstep_noted(NodeStatus status);
  // Throws: what the node did wrong.
  [[noreturn]] void lockstep_refuse(const char* what) const;
  bool lockstep_is_in_tree() const { return lockstep_place_ != nullptr; }
  // The time of the run; outside of a tree, of the machine: a test may override it.
  virtual double lockstep_seconds() const;
  template <class Ports>
  void modifyPortsRemapping(const Ports&) {
    static_assert(sizeof(Ports) == 0,
                  "lockstep binds the ports of a node to entries when the tree is loaded: use "
                  "config().blackboard to reach an entry by a name of your own");
  }

 private:
  friend class BehaviorTreeFactory;
  friend class ControlNode;
  friend class DecoratorNode;
  friend struct lockstep_detail::Leaf;
  friend class lockstep_detail::Child;
  friend class lockstep_detail::NodeThread;
  friend class lockstep_detail::Program;
  friend class lockstep_detail::TreeWatch;

  virtual NodeStatus lockstep_shown_status() const {
    return lockstep_status_.load(std::memory_order_acquire);
  }
  virtual void lockstep_forget_status() { setStatus(NodeStatus::IDLE); }
  // False: it has a result that no tick has returned yet.
  virtual bool lockstep_is_told() const { return true; }
  virtual void lockstep_find_children(lockstep_detail::Place&) {}

  [[noreturn]] void lockstep_refuse_idle() const;
  // Null: it has no such port.
  template <class T>
  Expected<T> lockstep_read(StringView name, const lockstep_detail::PortEntry* port) const;
  template <class T>
  Expected<T> lockstep_read_other(const lockstep_detail::PortEntry& port) const;
  template <class T>
  Expected<T> lockstep_read_default(const lockstep_detail::PortEntry& port) const;
  Expected<Any> lockstep_read_any(const lockstep_detail::PortEntry& port) const;
  [[gnu::always_inline]] const lockstep_detail::PortEntry* lockstep_find_port(
      StringView port) const;
  AnyPtrLocked lockstep_locked_port(const std::string& port);
  // A node outside of a tree reads and writes what its config says.
  template <class T>
  Expected<T> lockstep_read_by_hand(const std::string& port) const;
  Result lockstep_set_by_hand(const std::string& port, Any value, TypeInfo type);
  // The entry that a port is bound to; no board: none.
  Blackboard::LockstepPort lockstep_entry_of(const std::string& port) const;
  Timestamp lockstep_stamp_of(const std::string& port) const;
  std::string lockstep_no_port(StringView port) const;

  struct LockstepWatch {
    PreTickCallback before;
    PostTickCallback after;
    TickMonitorCallback monitor;
    StatusChangeSignal changes;
  };
  LockstepWatch& lockstep_watch();
  void lockstep_tell(NodeStatus status);
  template <class Work>
  [[gnu::always_inline]] NodeStatus lockstep_work(const Work& work);
  template <class Work>
  [[gnu::noinline]] NodeStatus lockstep_watched_work(Work work) {
    return lockstep_watched_tick([this, &work] { return lockstep_work(work); });
  }
  NodeStatus lockstep_watched_tick(const std::function<NodeStatus()>& work);
  // In a catch: a tree knows which of its nodes has thrown; the caller of another node is told.
  [[noreturn]] void lockstep_rethrow(const std::exception& thrown) const;

  std::string lockstep_name_;
  NodeConfig lockstep_config_;
  std::string lockstep_registration_name_;
  std::atomic<NodeStatus> lockstep_status_{NodeStatus::IDLE};
  lockstep_detail::Place* lockstep_place_ = nullptr;  // null: it is not in a tree
  lockstep_detail::NodeTree* lockstep_tree_ = nullptr;
  std::uint32_t lockstep_index_ = 0;                // in that tree
  std::unique_ptr<LockstepWatch> lockstep_watch_;   // null: nobody watches
  std::shared_ptr<WakeUpSignal> lockstep_wake_up_;  // of a node made by hand

  struct LockstepThreadPorts {
    std::vector<Expected<Any>> inputs;  // of each port
    std::vector<std::pair<const lockstep_detail::PortEntry*, Any>> outputs;
  };
  std::unique_ptr<LockstepThreadPorts> lockstep_thread_;  // while a thread runs its tick
};

// Gives each port the entry of its name, in the config of a node that a program makes.
template <class T>
void assignDefaultRemapping(NodeConfig& config) {
  for (const auto& [name, info] : getProvidedPorts<T>()) {
    if (info.direction() != PortDirection::OUTPUT) config.input_ports[name] = "{=}";
    if (info.direction() != PortDirection::INPUT) config.output_ports[name] = "{=}";
  }
}

}  // namespace BT

#include "behaviortree_cpp/lockstep/tree_node_functions.h"  // IWYU pragma: export
