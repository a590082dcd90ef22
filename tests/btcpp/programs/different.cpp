// What remains different: a line for each row of the tables in docs/btcpp.md that a program can
// show. different.txt is what it prints here, different.library what it prints over the library.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <streambuf>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

static std::string tree_of(const std::string& nodes) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + nodes + "</BehaviorTree></root>";
}

static void show(const std::string& row, const std::function<std::string()>& act) {
  std::string result;
  std::streambuf* const out = std::cout.rdbuf(nullptr);  // the library prints before it throws
  try {
    result = act();
  } catch (const std::exception&) {
    result = "throws";
  }
  std::cout.rdbuf(out);
  std::cout << row << ": " << result << std::endl;
}

// Answers with a letter for each tick, R, S, F or K (skipped), and keeps what happens.
class Answers : public ActionNodeBase {
 public:
  Answers(const std::string& name, const NodeConfig& config, std::string* events)
      : ActionNodeBase(name, config), events_(events) {
    if (name == "thrower") throw std::invalid_argument("no device");
  }
  static PortsList providedPorts() { return {InputPort<std::string>("answers", "S", "letters")}; }
  NodeStatus tick() override {
    const std::string answers = getInput<std::string>("answers").value();
    const char letter = answers[at_++ % answers.size()];
    *events_ += name() + letter + ' ';
    if (letter == 'X') throw RuntimeError("broken");
    return letter == 'R'   ? NodeStatus::RUNNING
           : letter == 'F' ? NodeStatus::FAILURE
           : letter == 'K' ? NodeStatus::SKIPPED
                           : NodeStatus::SUCCESS;
  }
  void halt() override {
    *events_ += name() + "H ";
    resetStatus();
  }

 private:
  std::string* events_;
  std::size_t at_ = 0;
};

// Runs until it has been ticked very often.
class Endless : public ActionNodeBase {
 public:
  Endless(const std::string& name, const NodeConfig& config) : ActionNodeBase(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    return ++ticks < 20'000 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }
  void halt() override { resetStatus(); }

  static std::atomic<int> ticks;
};
std::atomic<int> Endless::ticks{0};

// Ticks its first child, and tells whether it sees the class of that child.
class Looks : public ControlNode {
 public:
  Looks(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    const bool is_seen = dynamic_cast<Answers*>(children_nodes_[0]) != nullptr;
    children_nodes_[0]->executeTick();
    return is_seen ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
};

struct World {
  BehaviorTreeFactory factory;
  std::string events;
  World() {
    factory.registerNodeType<Answers>("Answers", &events);
    factory.registerNodeType<Looks>("Looks");
  }
  Tree make(const std::string& nodes) { return factory.createTreeFromText(tree_of(nodes)); }
  // The statuses of so many ticks, and the events.
  std::string tick(const std::string& nodes, int count) {
    auto tree = make(nodes);
    std::string statuses;
    for (int i = 0; i < count; ++i) statuses += toStr(tree.tickExactlyOnce()) + ' ';
    return statuses + "| " + events;
  }
};

static void show_nodes() {
  show("The end of a run", [] {
    World world;
    auto tree = world.make(
        "<Sequence><Answers name=\"a\"/><Answers name=\"b\" answers=\"R\"/><Answers name=\"c\"/>"
        "</Sequence>");
    tree.tickOnce();
    world.events.clear();
    tree.haltTree();
    return world.events;
  });
  show("A child of a control node",
       [] { return World().tick("<Looks><Answers name=\"a\"/></Looks>", 1); });
  show("An exception in a constructor", [] {
    try {
      World().make("<Answers name=\"thrower\"/>");
    } catch (const std::invalid_argument&) {
      return "is a std::invalid_argument";
    } catch (const RuntimeError&) {
      return "is a BT::RuntimeError";
    }
    return "is none";
  });
  show("After an exception", [] {
    World world;
    auto tree = world.make(
        "<Sequence><Answers name=\"a\"/><Answers name=\"b\" answers=\"XS\"/></Sequence>");
    try {
      tree.tickOnce();
    } catch (const NodeExecutionError&) {
      world.events += "throws ";
    }
    return toStr(tree.tickOnce()) + " | " + world.events;
  });
}

static void show_reactive() {
  ReactiveSequence::EnableException(false);
  ReactiveFallback::EnableException(false);
  show("ReactiveSequence::EnableException(true)", [] {
    ReactiveSequence::EnableException(true);
    return "is taken";
  });
}

static void show_boards() {
  World world;
  auto tree = world.make("<Sequence><Script code=\"n := 1; m := 2\"/></Sequence>");
  tree.tickOnce();
  const auto board = tree.rootBlackboard();
  show("Entry::value", [&] {
    board->getEntry("n")->value = Any(7.0);
    auto script = world.make("<AlwaysSuccess/>");
    return std::to_string(static_cast<int>(board->get<double>("n")));
  });
  show("The stamp of a write by a script", [&] {
    const auto after = std::chrono::steady_clock::now().time_since_epoch();
    return board->getStamped<int>("m")->stamp.time < after ? "is in the tick" : "is after the tick";
  });
  show("addSubtreeRemapping, enableAutoRemapping on a board of a tree that runs", [&] {
    board->addSubtreeRemapping("inner", "outer");
    return "is taken";
  });
  show("Whole numbers above the range of int64_t", [&] {
    board->set("large", std::numeric_limits<std::uint64_t>::max());
    return std::to_string(board->get<std::uint64_t>("large"));
  });
  show("An entry of int64_t", [&] {
    board->createEntry("long", TypeInfo::Create<std::int64_t>());
    board->set("long", 5);
    return std::to_string(board->get<std::int64_t>("long"));
  });
  show("A board outside of a tree", [] {
    World inner;
    auto outside = Blackboard::create();
    outside->set("seen", 0);
    int seen = 0;
    inner.factory.registerSimpleAction("Look", [outside, &seen](TreeNode&) {
      seen = outside->get<int>("seen");
      return NodeStatus::SUCCESS;
    });
    auto it = inner.factory.createTreeFromText(
        tree_of("<Sequence><Script code=\"@seen := 3\"/><Look/></Sequence>"),
        Blackboard::create(outside));
    it.tickOnce();
    return std::to_string(seen) + " within the tick, " + std::to_string(outside->get<int>("seen")) +
           " after it";
  });
  show("LoopInt, LoopDouble, LoopBool, LoopString", [] {
    World loops;
    auto it =
        loops.make("<LoopInt queue=\"{queue}\" value=\"{value}\"><Answers name=\"a\"/></LoopInt>");
    auto queue = std::make_shared<std::deque<int>>(std::deque<int>{1, 2});
    it.rootBlackboard()->set("queue", queue);
    return toStr(it.tickWhileRunning()) + " | " + loops.events;
  });
}

// Resets none of its children.
class Careless : public ControlNode {
 public:
  Careless(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    statuses += toStr(children_nodes_[0]->status()) + ' ';
    return children_nodes_[0]->executeTick();
  }
  static inline std::string statuses;
};

static void show_trees() {
  show(
      "Children that a control node of yours has not reset when it completes keep their results "
      "in its next activation",
      [] {
        World world;
        world.factory.registerNodeType<Careless>("Careless");
        world.tick("<Careless><Answers name=\"a\"/></Careless>", 2);
        return Careless::statuses;
      });
  show("A node that was skipped while it ran stays running", [] {
    World world;
    auto tree = world.make(
        "<Sequence><Answers name=\"a\" answers=\"RK\"/><Answers name=\"b\" answers=\"R\"/>"
        "</Sequence>");
    for (int i = 0; i < 2; ++i) tree.tickExactlyOnce();
    std::string statuses;
    tree.applyVisitor([&](const TreeNode* node) {
      if (node->name() == "a") statuses += toStr(node->status()) + ' ';
    });
    return statuses + "| " + world.events;
  });
  show("Precondition does not ask again after a halt", [] {
    World world;
    auto tree = world.make(
        "<Precondition if=\"go == 1\" else=\"FAILURE\"><Answers name=\"a\" answers=\"R\"/>"
        "</Precondition>");
    tree.rootBlackboard()->set("go", 1);
    std::string statuses = toStr(tree.tickExactlyOnce()) + ' ';
    tree.haltTree();
    tree.rootBlackboard()->set("go", 2);
    return statuses + toStr(tree.tickExactlyOnce());
  });
  show("IfThenElse without a third child keeps the failed condition", [] {
    World world;
    auto tree = world.make(
        "<Sequence><IfThenElse><Answers name=\"if\" answers=\"F\"/><Answers name=\"then\"/>"
        "</IfThenElse></Sequence>");
    std::string changes;
    const auto tell = [&](TimePoint, const TreeNode&, NodeStatus before, NodeStatus status) {
      changes += toStr(before) + "-" + toStr(status) + ' ';
    };
    const auto told = tree.subtrees[0]->nodes[2]->subscribeToStatusChange(tell);
    for (int i = 0; i < 2; ++i) tree.tickExactlyOnce();
    return changes;
  });
  show("SetBlackboard empties an entry without a type", [] {
    World world;
    auto tree = world.make(
        "<Sequence><Script code=\"k := 5\"/><SetBlackboard value=\"six\" output_key=\"k\"/>"
        "</Sequence>");
    tree.tickOnce();
    return tree.rootBlackboard()->get<std::string>("k");
  });
  show("code=\"{k}\" needs its text when the tree is loaded", [] {
    World world;
    auto tree = world.make(
        "<Sequence><SetBlackboard value=\"n := 4\" output_key=\"k\"/><Script code=\"{k}\"/>"
        "</Sequence>");
    return toStr(tree.tickOnce());
  });
  show("haltTree from another thread", [] {
    BehaviorTreeFactory factory;
    factory.registerNodeType<Endless>("Endless");
    auto tree = factory.createTreeFromText(tree_of("<Endless/>"));
    std::thread other([&tree] {
      while (Endless::ticks < 2) std::this_thread::yield();
      tree.haltTree();
    });
    const NodeStatus status = tree.tickWhileRunning(std::chrono::milliseconds(1));
    other.join();
    return toStr(status);
  });
  show("_onHalted runs for all nodes at the end", [] {
    World world;
    auto tree = world.make(
        "<Sequence><Answers name=\"a\" _onHalted=\"n := n + 1\"/><Answers name=\"b\" answers=\"R\""
        " _onHalted=\"n := n + 1\"/></Sequence>");
    tree.rootBlackboard()->set("n", 0);
    tree.tickOnce();
    tree.haltTree();
    return std::to_string(static_cast<int>(tree.rootBlackboard()->get<double>("n")));
  });
}

int main() {
  show_nodes();
  show_reactive();
  show_boards();
  show_trees();
  return 0;
}
