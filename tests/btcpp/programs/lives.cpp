// Lives of trees: after an exception, empty, moved, beside others, and longer than their factory.
#include <iostream>
#include <optional>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

static std::string tree_of(const std::string& nodes) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + nodes + "</BehaviorTree></root>";
}

template <class Act>
static void show(const char* what, const Act& act) {
  std::cout << what << ":";
  try {
    act();
  } catch (const NodeExecutionError& error) {
    std::cout << " throws of " << error.failedNode().node_name;
  } catch (const std::exception&) {
    std::cout << " throws";
  }
  std::cout << std::endl;
}

// Counts to three.
class Count : public StatefulActionNode {
 public:
  Count(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {OutputPort<int>("count")}; }
  NodeStatus onStart() override {
    count_ = 0;
    return onRunning();
  }
  NodeStatus onRunning() override {
    setOutput("count", ++count_);
    return count_ < 3 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }
  void onHalted() override { std::cout << " halted"; }

 private:
  int count_ = 0;
};

// A class may derive virtually from that of the library; lockstep asks it for its progress.
class Apart : public virtual StatefulActionNode {
 public:
  Apart(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("number", 4, "a number")}; }
  NodeStatus onStart() override { return NodeStatus::RUNNING; }
  NodeStatus onRunning() override {
    std::cout << ' ' << getInput<int>("number").value();
    return NodeStatus::SUCCESS;
  }
  void onHalted() override {}
  double progress() const { return 0.5; }
  void onPaused() {}
  void onResumed() {}
};

struct Fixture {
  BehaviorTreeFactory factory;
  int faults = 1;
  Fixture() {
    factory.registerNodeType<Count>("Count");
    factory.registerNodeType<Apart>("Apart");
    factory.registerSimpleAction("Breaks", [this](TreeNode&) -> NodeStatus {
      if (faults-- > 0) throw std::runtime_error("broken");
      return NodeStatus::SUCCESS;
    });
  }
  Tree make(const std::string& nodes) { return factory.createTreeFromText(tree_of(nodes)); }
};

int main() {
  Fixture with;
  {
    auto tree = with.make("<Sequence><Script code=\"n := 1\"/><Breaks/><Count/></Sequence>");
    show("it throws", [&] { tree.tickOnce(); });
    tree.haltTree();
    show("and is ticked again", [&] { std::cout << ' ' << toStr(tree.tickOnce()); });
    with.faults = 1;
    show("while it runs, it is halted", [&] { tree.haltTree(); });
    show("and throws again", [&] { tree.tickWhileRunning(); });
    tree.haltTree();
    show("and ends", [&] { std::cout << ' ' << toStr(tree.tickWhileRunning()); });
    std::cout << tree.rootBlackboard()->get<int>("n") << std::endl;
  }
  {
    Tree empty;
    show("empty", [&] { std::cout << ' ' << (empty.rootNode() == nullptr); });
    show("it has no blackboard", [&] { std::cout << ' ' << !empty.rootBlackboard(); });
    show("it is halted", [&] { empty.haltTree(); });
    show("it has no nodes to visit",
         [&] { empty.applyVisitor([](TreeNode*) { std::cout << "one"; }); });
    show("it is ticked", [&] { empty.tickOnce(); });
    empty = with.make("<AlwaysSuccess/>");
    show("it is another one", [&] { std::cout << ' ' << toStr(empty.tickOnce()); });
  }
  {
    Tree first = with.make("<Count count=\"{n}\"/>");
    first.tickOnce();
    Tree second = std::move(first);
    second.tickOnce();
    show("moved", [&] { std::cout << second.rootBlackboard()->get<int>("n"); });
    show("the rest is empty", [&] { std::cout << (first.rootNode() == nullptr); });  // NOLINT
    second.haltTree();
    std::cout << std::endl;
  }
  {
    std::optional<Tree> tree;
    Blackboard::Ptr board;
    {
      Fixture gone;
      tree.emplace(gone.make("<Sequence><Apart/><Count count=\"{n}\"/></Sequence>"));
    }
    show("the factory is gone", [&] { std::cout << ' ' << toStr(tree->tickWhileRunning()); });
    board = tree->rootBlackboard();
    tree.reset();
    show("and the tree", [&] { std::cout << ' ' << board->get<int>("n"); });
  }
  {
    Tree one = with.make("<Repeat num_cycles=\"50\"><Count count=\"{n}\"/></Repeat>");
    Tree two = with.make("<Repeat num_cycles=\"50\"><Count count=\"{n}\"/></Repeat>");
    const auto run = [](Tree& tree) { tree.tickWhileRunning(std::chrono::milliseconds(0)); };
    std::thread other(run, std::ref(two));
    run(one);
    other.join();
    show("two at once", [&] {
      std::cout << ' ' << toStr(one.rootNode()->status()) << ' '
                << two.rootBlackboard()->get<int>("n");
    });
  }
  return 0;
}
