// The headers take no ordinary name from a user: free functions, types, and members of another base
// class mean in a class of nodes what they mean outside.
#include <iostream>

#include "behaviortree_cpp/actions/pop_from_queue.hpp"
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/controls/reactive_fallback.h"
#include "behaviortree_cpp/controls/reactive_sequence.h"
#include "behaviortree_cpp/decorators/loop_node.h"

using namespace BT;

// clang-format off
#define ORDINARY_NAMES(X) \
  X(add) X(add_simple) X(after) X(apply) X(at) X(attach) X(before) X(begin) X(begin_thread) \
  X(begins) X(board) X(build) X(busy) X(call) X(cancel) X(changed) X(check) X(check_class) \
  X(choose) X(clear) X(clone) X(close) X(command) X(compute) X(coroutine) X(count) X(create) \
  X(current) X(data) X(decide) X(deadline) X(device) X(documents) X(done) X(drive) X(elapsed) \
  X(end) X(end_thread) X(entries) X(entry) X(error) X(event) X(execute) X(fail) X(failed) \
  X(feedback) X(fetch) X(field) X(find) X(find_children) X(find_items) X(finish) X(first) \
  X(flag) X(forget) X(forget_status) X(function) X(get) X(goal) X(goes_on) X(grab) X(handle) \
  X(has_come) X(has_value) X(hold) X(host) X(id) X(index) X(info) X(init) X(input) X(is_async) \
  X(is_done) X(is_text) X(item) X(items) X(job) X(keep) X(kind) X(last) X(launch) X(left) \
  X(length) X(limit) X(list) X(load) X(lock) X(log) X(look) X(loop) X(make) X(manager) X(map) \
  X(message) X(mode) X(monitor) X(most) X(move) X(next) X(no_port) X(node) X(nodes) X(note) \
  X(notify) X(now) X(number) X(object) X(observer) X(of) X(open) X(output) X(owned) X(owner) \
  X(parent) X(parse) X(part) X(period) X(pick) X(place) X(plan) X(plugin) X(plugins) X(point) \
  X(pop) X(port) X(ports) X(pose) X(position) X(prefix) X(prepare) X(print) X(process) \
  X(program) X(publish) X(push) X(query) X(queue) X(range) X(rate) X(read) X(read_any) \
  X(read_default) X(read_most) X(read_other) X(ready) X(receive) X(record) X(registration_name) \
  X(release) X(remove) X(report) X(request) X(require) X(reset) X(result) X(resume) X(retry) \
  X(root) X(run) X(save) X(say) X(seconds) X(select) X(send) X(server) X(set) X(shared) X(show) \
  X(shown_status) X(signal) X(size) X(skip) X(skipped) X(source) X(speed) X(spin) X(start) \
  X(started) X(state) X(statuses) X(step) X(steps) X(stop) X(store) X(success) X(sum) X(table) \
  X(take) X(target) X(task) X(tell) X(text) X(thread) X(tick_child) X(time) X(timeout) X(timer) \
  X(token) X(total) X(trace) X(track) X(turn) X(update) X(use) X(user) X(value) X(values) \
  X(wait) X(wake) X(watch) X(watched_tick) X(work) X(worker) X(write)

#define ORDINARY_TYPES(X) \
  X(AgainNode) X(AsyncActionNode) X(Caller) X(Child) X(Coroutine) X(Device) X(Documents) X(Goal) \
  X(Leaf) X(NodeThread) X(Object) X(Place) X(Program) X(Queue) X(QueueAction) X(ReactiveRowNode) \
  X(Registration) X(RowNode) X(State) X(Table) X(Task) X(ThreadPorts) X(Timer) X(Token) X(Watch) \
  X(Worker)
// clang-format on

// What a project has outside of its nodes.
#define FREE_FUNCTION(name) \
  static int name() {       \
    return 1;               \
  }
ORDINARY_NAMES(FREE_FUNCTION)
#define TYPE(name) \
  struct name {    \
    int it = 1;    \
  };
ORDINARY_TYPES(TYPE)
namespace detail {
static int helper() {
  return 1;
}
}  // namespace detail

// And what it derives its nodes from, too.
#define MEMBER_FUNCTION(name) \
  int name() const {          \
    return name##_;           \
  }
#define DATA_MEMBER(name) int name##_ = 1;
struct Project {
  ORDINARY_NAMES(MEMBER_FUNCTION)
  ORDINARY_NAMES(DATA_MEMBER)
};

#define CALLED(name) +name()
#define READ(name) +name##_
#define MADE(name) +name().it
#define USES_OF_OUTER                                   \
  int outer() const {                                   \
    return 0 ORDINARY_NAMES(CALLED) + detail::helper(); \
  }
#define USES_OF_BASE                                      \
  int inner() const {                                     \
    return 0 ORDINARY_NAMES(CALLED) ORDINARY_NAMES(READ); \
  }
#define USES_OF_TYPES              \
  int types() const {              \
    return 0 ORDINARY_TYPES(MADE); \
  }

// Abstract classes are enough: the names are looked up where they are written.
#define NODES(Base)                    \
  struct Outer##Base : Base {          \
    using Base::Base;                  \
    USES_OF_OUTER USES_OF_TYPES        \
  };                                   \
  struct Inner##Base : Base, Project { \
    using Base::Base;                  \
    USES_OF_BASE                       \
  };

using IntLoop = LoopNode<int>;
using IntPop = PopFromQueue<int>;
using IntQueueSize = QueueSize<int>;
using TwoCases = SwitchNode<2>;
NODES(TreeNode)
NODES(LeafNode)
NODES(ActionNodeBase)
NODES(SyncActionNode)
NODES(SimpleActionNode)
NODES(StatefulActionNode)
NODES(CoroActionNode)
NODES(ThreadedAction)
NODES(ConditionNode)
NODES(SimpleConditionNode)
NODES(DecoratorNode)
NODES(SimpleDecoratorNode)
NODES(ControlNode)
NODES(SequenceNode)
NODES(FallbackNode)
NODES(SequenceWithMemory)
NODES(ReactiveSequence)
NODES(ReactiveFallback)
NODES(ParallelNode)
NODES(ParallelAllNode)
NODES(IfThenElseNode)
NODES(WhileDoElseNode)
NODES(TwoCases)
NODES(TryCatchNode)
NODES(InverterNode)
NODES(ForceSuccessNode)
NODES(ForceFailureNode)
NODES(KeepRunningUntilFailureNode)
NODES(RepeatNode)
NODES(RetryNode)
NODES(RunOnceNode)
NODES(DelayNode)
NODES(TimeoutNode)
NODES(SubTreeNode)
NODES(EntryUpdatedDecorator)
NODES(AlwaysSuccessNode)
NODES(AlwaysFailureNode)
NODES(SleepNode)
NODES(SetBlackboardNode)
NODES(UnsetBlackboardNode)
NODES(EntryUpdatedAction)
NODES(IntLoop)
NODES(IntPop)
NODES(IntQueueSize)
NODES(BehaviorTreeFactory)

class Sum : public InnerSyncActionNode {
 public:
  Sum(const std::string& name, const NodeConfig& config) : InnerSyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << (inner() > 300 ? " has all" : " lacks some") << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Sum>("Sum");
}
