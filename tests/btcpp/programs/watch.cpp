// A program that watches its tree while it is ticked: hooks on all nodes, each change of a status
// when it happens, statistics, logs, and wake-ups.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/bt_cout_logger.h"
#include "behaviortree_cpp/loggers/bt_file_logger_v2.h"
#include "behaviortree_cpp/loggers/bt_minitrace_logger.h"
#include "behaviortree_cpp/loggers/bt_observer.h"

using namespace BT;

namespace {

NodeStatus status_of(const std::string& text) {
  if (text == "S") return NodeStatus::SUCCESS;
  return text == "F" ? NodeStatus::FAILURE : NodeStatus::SKIPPED;
}

class Once : public SyncActionNode {
 public:
  Once(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<std::string>("r")}; }
  NodeStatus tick() override { return status_of(getInput<std::string>("r").value()); }
};

class Count : public SyncActionNode {
 public:
  Count(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {OutputPort<int>("n")}; }
  NodeStatus tick() override {
    setOutput("n", ++count_);
    return NodeStatus::SUCCESS;
  }

 private:
  int count_ = 0;
};

class Ask : public ConditionNode {
 public:
  Ask(const std::string& name, const NodeConfig& config) : ConditionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<std::string>("r")}; }
  NodeStatus tick() override { return status_of(getInput<std::string>("r").value()); }
};

class Work : public StatefulActionNode {
 public:
  Work(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("n"), InputPort<std::string>("r")}; }
  NodeStatus onStart() override {
    left_ = getInput<int>("n").value();
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override {
    return --left_ > 0 ? NodeStatus::RUNNING : status_of(getInput<std::string>("r").value());
  }
  void onHalted() override { std::cout << "    " << name() << " onHalted" << std::endl; }

 private:
  int left_ = 0;
};

// Waits until a thread calls it back, as a client of a service does.
class Reply : public StatefulActionNode {
 public:
  Reply(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  ~Reply() override {
    if (thread_.joinable()) thread_.join();
  }
  static PortsList providedPorts() { return {}; }
  NodeStatus onStart() override {
    thread_ = std::thread([this] {
      is_there_ = true;
      emitWakeUpSignal();
    });
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override { return is_there_ ? NodeStatus::SUCCESS : NodeStatus::RUNNING; }
  void onHalted() override {}

 private:
  std::atomic<bool> is_there_{false};
  std::thread thread_;
};

class Printer : public StatusChangeLogger {
 public:
  explicit Printer(const Tree& tree) : StatusChangeLogger(tree.rootNode()) {
    enableTransitionToIdle(true);
  }
  void callback(Duration, const TreeNode& node, NodeStatus before, NodeStatus now) override {
    std::cout << "    " << node.name() << " " << toStr(before) << " -> " << toStr(now) << std::endl;
  }
  void flush() override {}
};

void register_nodes(BehaviorTreeFactory& factory) {
  factory.registerNodeType<Once>("Once");
  factory.registerNodeType<Count>("Count");
  factory.registerNodeType<Ask>("Ask");
  factory.registerNodeType<Work>("Work");
  factory.registerNodeType<Reply>("Reply");
}

std::string document(const std::string& body) {
  return R"(<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">)" +
         body + R"(</BehaviorTree>
  <BehaviorTree ID="Part"><Sequence name="in"><Once name="ia" r="S"/><Work name="iw" n="1" r="S"/>
  </Sequence></BehaviorTree></root>)";
}

const std::vector<std::pair<std::string, std::string>> kTrees{
    {"Sequence",
     R"(<Sequence name="s"><Once name="a" r="S"/><Work name="w" n="2" r="S"/></Sequence>)"},
    {"Fallback",
     R"(<Fallback name="f"><Once name="a" r="F"/><Work name="w" n="1" r="F"/></Fallback>)"},
    {"SequenceWithMemory that fails",
     R"(<SequenceWithMemory name="m"><Work name="v" n="1" r="S"/><Work name="w" n="1" r="F"/>
     </SequenceWithMemory>)"},
    {"ReactiveSequence",
     R"(<ReactiveSequence name="rs"><Ask name="c" r="S"/><Work name="w" n="2" r="S"/>
     </ReactiveSequence>)"},
    {"ReactiveFallback",
     R"(<ReactiveFallback name="rf"><Ask name="c" r="F"/><Work name="w" n="2" r="F"/>
     </ReactiveFallback>)"},
    {"Parallel that halts",
     R"(<Parallel name="p" success_count="1"><Sequence name="q"><Once name="a" r="S"/>
     <Work name="v" n="9" r="S"/></Sequence><Work name="w" n="1" r="S"/></Parallel>)"},
    {"ParallelAll",
     R"(<ParallelAll name="p" max_failures="1"><Work name="v" n="1" r="S"/>
     <Work name="w" n="2" r="F"/></ParallelAll>)"},
    {"IfThenElse",
     R"(<IfThenElse name="i"><Ask name="c" r="F"/><Once name="a" r="S"/><Once name="b" r="F"/>
     </IfThenElse>)"},
    {"WhileDoElse",
     R"(<WhileDoElse name="i"><Ask name="c" r="S"/><Work name="w" n="1" r="S"/><Once name="b" r="F"/>
     </WhileDoElse>)"},
    {"Switch",
     R"(<Switch2 name="sw" variable="1" case_1="1" case_2="2"><Work name="w" n="1" r="S"/>
     <Once name="b" r="S"/><Once name="c" r="S"/></Switch2>)"},
    {"Inverter", R"(<Inverter name="d"><Work name="w" n="1" r="S"/></Inverter>)"},
    {"ForceSuccess", R"(<ForceSuccess name="d"><Work name="w" n="1" r="F"/></ForceSuccess>)"},
    {"Timeout", R"(<Timeout name="d" msec="10000"><Work name="w" n="1" r="S"/></Timeout>)"},
    {"RunOnce",
     R"(<Fallback name="f"><RunOnce name="d" then_skip="false"><Work name="w" n="1" r="F"/></RunOnce>
     </Fallback>)"},
    {"Precondition",
     R"(<Precondition name="d" if="true" else="FAILURE"><Work name="w" n="1" r="S"/>
     </Precondition>)"},
    {"leaves of the language",
     R"(<Sequence name="s"><Script name="sc" code="x:=1"/><AlwaysSuccess name="as"/>
     <SetBlackboard name="sb" output_key="y" value="3"/><AlwaysFailure name="af"/></Sequence>)"},
    {"SubTree",
     R"(<Sequence name="s"><SubTree ID="Part" name="st"/><Once name="b" r="S"/></Sequence>)"},
    {"scripts that decide",
     R"(<Sequence name="s"><Once name="a" r="S" _skipIf="true"/><Sequence name="t">
     <Work name="w" n="1" r="S" _skipIf="true"/></Sequence><Work name="z" n="1" r="S" _successIf="true"/>
     </Sequence>)"},
    {"all skipped", R"(<Sequence name="s"><Once name="a" r="S" _skipIf="true"/></Sequence>)"},
    {"decorators in a Fallback",
     R"(<Fallback name="f"><Inverter name="i"><AlwaysSuccess name="x"/></Inverter>
     <ForceFailure name="ff"><Once name="q" r="S"/></ForceFailure><Once name="l" r="S"/></Fallback>)"},
    {"halted from outside",
     R"(<Sequence name="s"><Once name="a" r="S"/><Sequence name="t"><Work name="w" n="9" r="S"/>
     </Sequence></Sequence>)"},
};

void tell_changes() {
  for (const auto& [title, body] : kTrees) {
    BehaviorTreeFactory factory;
    register_nodes(factory);
    Tree tree = factory.createTreeFromText(document(body));
    const Printer printer(tree);
    std::cout << title << std::endl;
    for (int i = 0; i < 3; ++i) {
      const NodeStatus status = tree.tickExactlyOnce();
      std::cout << "  " << toStr(status) << ":";
      tree.applyVisitor([](const TreeNode* node) {
        std::cout << " " << node->name() << " " << toStr(node->status());
      });
      std::cout << std::endl;
      if (status != NodeStatus::RUNNING) break;
    }
    tree.haltTree();
  }
}

// The statuses are those of the library also when nobody subscribes.
void tell_statuses() {
  std::cout << "nobody subscribes" << std::endl;
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(kTrees.front().second));
  for (int i = 0; i < 3; ++i) {
    tree.tickExactlyOnce();
    tree.applyVisitor([](const TreeNode* node) {
      std::cout << "  " << node->name() << " " << toStr(node->status());
    });
    std::cout << std::endl;
  }
}

TreeNode& find(Tree& tree, const std::string& name) {
  TreeNode* found = nullptr;
  tree.applyVisitor([&](TreeNode* node) {
    if (node->name() == name) found = node;
  });
  if (found == nullptr) throw std::runtime_error("no node " + name);
  return *found;
}

void tell_hooks() {
  std::cout << "hooks" << std::endl;
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(
      R"(<Sequence><Count n="{n}"/><Fallback name="f"><Sequence name="s" _successIf="n == 4">
      <Once name="a" r="S"/><AlwaysFailure name="b"/></Sequence>
      <Inverter name="i"><AlwaysSuccess name="x"/></Inverter></Fallback></Sequence>)"));
  int before = 0, after = 0, timed = 0;
  NodeStatus first = NodeStatus::IDLE, last = NodeStatus::IDLE;
  TreeNode& sequence = find(tree, "s");
  sequence.setPreTickFunction([&](TreeNode&) {
    ++before;
    return first;
  });
  sequence.setPostTickFunction([&](TreeNode&, NodeStatus) {
    ++after;
    return last;
  });
  sequence.setTickMonitorCallback(
      [&](TreeNode&, NodeStatus, std::chrono::microseconds) { ++timed; });
  const auto tell = [&](const char* title) {
    std::cout << "  " << title << ": " << toStr(tree.tickExactlyOnce()) << ", " << before
              << " before, " << after << " after, " << timed << " timed" << std::endl;
  };
  tell("they only look");
  first = NodeStatus::SUCCESS;
  tell("a result before the tick");
  first = NodeStatus::IDLE;
  last = NodeStatus::SUCCESS;
  tell("a result after the tick");
  last = NodeStatus::IDLE;
  tell("a script decides");
  find(tree, "b").setPreTickFunction([](TreeNode&) { return NodeStatus::SUCCESS; });
  tell("a leaf of the language");
  find(tree, "a").setPreTickFunction([](TreeNode&) { return NodeStatus::FAILURE; });
  tell("a leaf of the program");
  int changes = 0;
  {
    const auto subscriber = find(tree, "i").subscribeToStatusChange(
        [&](TimePoint, const TreeNode&, NodeStatus, NodeStatus) { ++changes; });
    tree.tickExactlyOnce();
  }
  tree.tickExactlyOnce();
  std::cout << "  an Inverter has changed " << changes << " times" << std::endl;
  find(tree, "i").setPreTickFunction(
      [](TreeNode&) -> NodeStatus { throw std::runtime_error("from a hook"); });
  try {
    tree.tickExactlyOnce();
    std::cout << "  it is lost" << std::endl;
  } catch (const std::exception& error) {
    const bool is_it = std::string(error.what()).find("from a hook") != std::string::npos;
    std::cout << "  what a hook throws leaves the tick: " << is_it << std::endl;
  }
}

void tell_statistics() {
  std::cout << "statistics" << std::endl;
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(kTrees[16].second));
  TreeObserver observer(tree);
  for (int i = 0; i < 3; ++i) tree.tickWhileRunning(std::chrono::milliseconds(0));
  for (const auto& [path, uid] : std::map<std::string, std::uint16_t>(observer.pathToUID().begin(),
                                                                      observer.pathToUID().end())) {
    const auto& it = observer.getStatistics(uid);
    std::cout << "  " << path << ": " << it.transitions_count << " transitions, "
              << it.success_count << " successes, " << it.failure_count << " failures, "
              << toStr(it.last_result) << ", " << toStr(it.current_status) << ", "
              << (observer.uidToPath().at(uid) == path) << std::endl;
  }
}

// Nodes of the language are objects of the library's classes.
void tell_classes() {
  std::cout << "classes" << std::endl;
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(
      R"(<Fallback name="f"><Sequence name="s"><Inverter name="i"><Once name="a" r="S"/></Inverter>
      </Sequence><AlwaysSuccess name="x"/></Fallback>)"));
  std::cout << "  sequences: " << tree.getNodesByPath<SequenceNode>("*").size()
            << ", of the program: " << tree.getNodesByPath<Once>("*").size() << std::endl;
  const auto* const root = dynamic_cast<const FallbackNode*>(tree.rootNode());
  std::cout << "  children of the root: " << root->childrenCount() << std::endl;
  const auto* const sequence = dynamic_cast<const ControlNode*>(root->child(0));
  const auto* const inverter = dynamic_cast<const InverterNode*>(sequence->child(0));
  std::cout << "  below it: " << inverter->name() << " " << inverter->child()->name() << std::endl;
}

std::uint64_t number_at(const std::string& bytes, std::size_t place, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = count; i-- > 0;) {
    number = number << 8 | static_cast<unsigned char>(bytes[place + i]);
  }
  return number;
}

std::string read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void tell_logs() {
  std::cout << "logs" << std::endl;
  const auto folder = std::filesystem::temp_directory_path();
  const auto log = folder / ("watch_" + std::to_string(getpid()) + ".btlog");
  const auto trace = folder / ("watch_" + std::to_string(getpid()) + ".json");
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(kTrees.front().second));
  {
    FileLogger2 file(tree, log);
    MinitraceLogger marks(tree, trace.c_str());
    tree.tickWhileRunning(std::chrono::milliseconds(0));
    file.flush();
    marks.flush();
  }
  const std::string bytes = read(log);
  const std::size_t length = number_at(bytes, 19, 4);
  std::cout << "  " << bytes.substr(0, 18) << " " << int(bytes[18])
            << ", a root: " << (bytes.substr(23, length).find("<root") != std::string::npos)
            << ", records:";
  for (std::size_t i = 23 + length + 8; i < bytes.size(); i += 9) {
    std::cout << " " << number_at(bytes, i + 6, 2) << "=" << number_at(bytes, i + 8, 1);
  }
  std::cout << std::endl;
  std::cout << "  a trace: " << (read(trace).find("\"traceEvents\"") != std::string::npos)
            << std::endl;
  std::filesystem::remove(log);
  std::filesystem::remove(trace);
  try {
    const FileLogger2 wrong(tree, folder / "watch.txt");
    std::cout << "  any extension" << std::endl;
  } catch (const RuntimeError&) {
    std::cout << "  another extension is refused" << std::endl;
  }
}

// None of these waits for its time to be over.
void tell_wake_ups() {
  std::cout << "wake-ups" << std::endl;
  constexpr auto kLong = std::chrono::seconds(60);
  BehaviorTreeFactory factory;
  register_nodes(factory);
  Tree tree = factory.createTreeFromText(document(R"(<Reply name="r"/>)"));
  std::cout << "  a thread of a node: " << toStr(tree.tickWhileRunning(kLong)) << std::endl;
  std::thread other([&tree] { tree.emitWakeUpSignal(); });
  std::cout << "  the tree: " << tree.sleep(kLong) << std::endl;
  other.join();
  Tree twice = factory.createTreeFromText(document(
      R"(<Sequence name="s"><Work name="w" n="1" r="S"/><Once name="a" r="S"/></Sequence>)"));
  std::cout << "  exactly once: " << toStr(twice.tickExactlyOnce()) << std::endl;
}

}  // namespace

int main() {
  tell_changes();
  tell_statuses();
  tell_hooks();
  tell_statistics();
  tell_classes();
  tell_logs();
  tell_wake_ups();
}
