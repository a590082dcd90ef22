// A program that makes nodes by hand, without a tree, as unit tests do. The laws are those of the
// nodes of a tree.
#include <cstdio>
#include <iostream>
#include <iterator>
#include <map>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"
#include "nodes/btcpp_control_laws.h"
#include "nodes/btcpp_decorator_laws.h"

using namespace BT;
using lockstep::host::test::TickRow;

namespace {

double seconds = 0;
// "tick a", "halt b", in their order.
std::vector<std::pair<std::string, std::string>> calls;

const auto wake_up = std::make_shared<WakeUpSignal>();

// A node whose time is that of this program, and that can ask it for a tick.
template <class Node>
class OnClock : public Node {
 public:
  template <class... Arguments>
  explicit OnClock(const std::string& name, const Arguments&... arguments)
      : Node(name, arguments...) {
    this->setWakeUpInstance(wake_up);
  }

 private:
  double lockstep_seconds() const override { return seconds; }
};

// The next letter of what it is given with each tick; the last one stays.
class Script {
 public:
  explicit Script(std::string letters) : letters_(std::move(letters)) {}
  NodeStatus next() {
    const char letter = letters_[std::min(done_++, letters_.size() - 1)];
    return letter == 'R'   ? NodeStatus::RUNNING
           : letter == 'S' ? NodeStatus::SUCCESS
           : letter == 'F' ? NodeStatus::FAILURE
                           : NodeStatus::SKIPPED;
  }

 private:
  std::string letters_;
  std::size_t done_ = 0;
};

class Act : public StatefulActionNode {
 public:
  Act(const std::string& name, std::string letters)
      : StatefulActionNode(name, {}), script_(std::move(letters)) {}
  NodeStatus onStart() override { return onRunning(); }
  NodeStatus onRunning() override {
    calls.emplace_back("tick", name());
    return script_.next();
  }
  void onHalted() override { calls.emplace_back("halt", name()); }

 private:
  Script script_;
};

class Ask : public ConditionNode {
 public:
  Ask(const std::string& name, std::string letters)
      : ConditionNode(name, {}), script_(std::move(letters)) {}
  NodeStatus tick() override {
    calls.emplace_back("tick", name());
    return script_.next();
  }

 private:
  Script script_;
};

using Texts = std::map<std::string, std::string>;

// The nodes of a law: Parallel[success_count=1](a b?), a leaf is an action, or with '?' a
// condition.
class Made {
 public:
  Made(StringView tree, Texts leaves) : text_(tree), leaves_(std::move(leaves)) { root_ = node(); }

  TreeNode& root() { return *root_; }

 private:
  using Make = std::unique_ptr<TreeNode> (*)(const std::string& id, const NodeConfig&);

  template <class Node>
  static std::unique_ptr<TreeNode> by_name(const std::string& id, const NodeConfig&) {
    return std::make_unique<OnClock<Node>>(id);
  }
  template <class Node>
  static std::unique_ptr<TreeNode> by_config(const std::string& id, const NodeConfig& config) {
    return std::make_unique<OnClock<Node>>(id, config);
  }
  template <class Node>
  static std::unique_ptr<TreeNode> by_number(const std::string& id, const NodeConfig& config) {
    return std::make_unique<OnClock<Node>>(id, std::stoi(config.input_ports.begin()->second));
  }
  template <class Node>
  static std::unique_ptr<TreeNode> async(const std::string& id, const NodeConfig&) {
    return std::make_unique<OnClock<Node>>(id, true);
  }
  static std::unique_ptr<TreeNode> parallel(const std::string& id, const NodeConfig& config) {
    auto node = std::make_unique<ParallelNode>(id);
    for (const auto& [port, value] : config.input_ports) {
      if (port == "success_count") node->setSuccessThreshold(std::stoi(value));
      if (port == "failure_count") node->setFailureThreshold(std::stoi(value));
    }
    return node;
  }
  static std::unique_ptr<TreeNode> parallel_all(const std::string& id, const NodeConfig& config) {
    NodeConfig with_default = config;
    with_default.input_ports.emplace("max_failures", "1");
    return std::make_unique<ParallelAllNode>(id, with_default);
  }

  static const std::map<std::string, Make>& kinds() {
    static const std::map<std::string, Make> all{
        {"Sequence", by_name<SequenceNode>},
        {"AsyncSequence", async<SequenceNode>},
        {"SequenceWithMemory", by_name<SequenceWithMemory>},
        {"Fallback", by_name<FallbackNode>},
        {"AsyncFallback", async<FallbackNode>},
        {"ReactiveSequence", by_name<ReactiveSequence>},
        {"ReactiveFallback", by_name<ReactiveFallback>},
        {"Parallel", parallel},
        {"ParallelAll", parallel_all},
        {"IfThenElse", by_name<IfThenElseNode>},
        {"WhileDoElse", by_name<WhileDoElseNode>},
        {"Switch2", by_config<SwitchNode<2>>},
        {"TryCatch", by_config<TryCatchNode>},
        {"Inverter", by_name<InverterNode>},
        {"ForceSuccess", by_name<ForceSuccessNode>},
        {"ForceFailure", by_name<ForceFailureNode>},
        {"Repeat", by_number<RepeatNode>},
        {"RetryUntilSuccessful", by_number<RetryNode>},
        {"KeepRunningUntilFailure", by_name<KeepRunningUntilFailureNode>},
        {"RunOnce", by_config<RunOnceNode>},
        {"Delay", by_number<DelayNode>},
        {"Timeout", by_number<TimeoutNode>},
        {"Sleep", by_config<SleepNode>}};
    return all;
  }

  std::string take_until(StringView ends) {
    const std::size_t length = std::min(text_.find_first_of(ends), text_.size());
    const std::string taken(text_.substr(0, length));
    text_.remove_prefix(length);
    return taken;
  }
  bool take(char character) {
    if (text_.empty() || text_.front() != character) return false;
    text_.remove_prefix(1);
    return true;
  }

  TreeNode* node() {
    const std::string id = take_until("[( )?");
    if (id.front() >= 'a') return leaf(id);
    NodeConfig config;
    if (take('[')) {
      while (!take(']')) {
        const std::string port = take_until("=");
        take('=');
        config.input_ports[port] = take_until(" ]");
        take(' ');
      }
    }
    TreeNode* const made = keep(kinds().at(id)(id, config));
    if (take('(')) {
      while (!take(')')) {
        add(*made, node());
        take(' ');
      }
    }
    return made;
  }
  TreeNode* leaf(const std::string& name) {
    if (take('?')) return keep(std::make_unique<Ask>(name, leaves_.at(name)));
    return keep(std::make_unique<Act>(name, leaves_.at(name)));
  }
  static void add(TreeNode& parent, TreeNode* child) {
    if (auto* const control = dynamic_cast<ControlNode*>(&parent)) control->addChild(child);
    if (auto* const decorator = dynamic_cast<DecoratorNode*>(&parent)) decorator->setChild(child);
  }
  TreeNode* keep(std::unique_ptr<TreeNode> made) {
    return all_.emplace_back(std::move(made)).get();
  }

  StringView text_;
  Texts leaves_;
  std::vector<std::unique_ptr<TreeNode>> all_;
  TreeNode* root_;
};

// "a=SR.5 b=F" without the progresses.
Texts leaves_of(StringView text) {
  Texts leaves;
  for (const StringView part : splitString(text, ' ')) {
    std::string letters;
    for (const char it : part.substr(2)) {
      if (it >= 'A' && it <= 'Z') letters += it;
    }
    leaves[std::string(part.substr(0, 1))] = letters;
  }
  return leaves;
}

// "R[a b] S[b] halt[a]": ticks, each with what comes of it; without progresses and faults.
std::vector<std::string> steps_of(StringView text) {
  std::vector<std::string> words(1), steps;
  int depth = 0;
  for (const char it : text) {
    depth += it == '[' ? 1 : it == ']' ? -1 : 0;
    if (it == ' ' && depth == 0) {
      words.emplace_back();
    } else {
      words.back() += it;
    }
  }
  for (std::string& word : words) {
    word.erase(std::min(word.find('='), word.size()));
    if (word.front() >= 'a') {
      steps.back() += " " + word;
    } else {
      steps.push_back(word);
    }
  }
  return steps;
}

std::string summary(char result) {
  std::string ticks, halts;
  for (const auto& [call, name] : calls) {
    std::string& list = call == "tick" ? ticks : halts;
    list += (list.empty() ? "" : " ") + name;
  }
  return std::string(1, result) + "[" + ticks + "]" + (halts.empty() ? "" : " halt[" + halts + "]");
}

char tick(TreeNode& root) {
  try {
    const NodeStatus result = root.executeTick();
    if (isStatusCompleted(result)) root.haltNode();
    return "IRSFK"[static_cast<int>(result)];
  } catch (const NodeExecutionError&) {
    return 'X';
  }
}

// It is ticked again when a node asks for it, as a tree is.
std::string play(TreeNode& root) {
  calls.clear();
  char result = tick(root);
  while (result == 'R' && wake_up->waitFor({})) result = tick(root);
  return summary(result);
}

bool check(const TickRow& row) {
  Made made(row.tree, leaves_of(row.leaves));
  seconds = 0;
  for (const std::string& expected : steps_of(row.expected)) {
    const std::string got = play(made.root());
    seconds += row.period;
    if (got == expected) continue;
    std::cout << "broken: " << row.law << "\n  " << row.tree << "  " << row.leaves << "\n  "
              << row.expected << "\n  " << got << " in place of " << expected << std::endl;
    return false;
  }
  return true;
}

// Scripts, and what only lockstep has.
bool is_of_hands(const TickRow& row) {
  for (const StringView part :
       {"Script", "Precondition", "Update", "ParallelRelative", "ParallelAbsolute"}) {
    if (row.tree.find(part) != StringView::npos) return false;
  }
  return true;
}

template <std::size_t kCount>
int check_all(const TickRow (&rows)[kCount]) {
  int held = 0;
  for (const TickRow& row : rows) held += is_of_hands(row) && check(row) ? 1 : 0;
  return held;
}

void check_laws() {
  using namespace lockstep::host::test;
  const int held =
      check_all(kSequences) + check_all(kParallels) + check_all(kBranches) + check_all(kDecorators);
  std::cout << (held >= 100 ? "the laws hold" : "laws are missing: " + std::to_string(held))
            << std::endl;
}

// Blocks in its thread until it is halted, or told to end.
class Block : public ThreadedAction {
 public:
  explicit Block(const std::string& name) : ThreadedAction(name, {}) {}
  ~Block() override { halt(); }
  NodeStatus tick() override {
    while (!is_over && !isHaltRequested()) std::this_thread::yield();
    return NodeStatus::SUCCESS;
  }
  std::atomic<bool> is_over{false};
};

class Yield : public CoroActionNode {
 public:
  explicit Yield(const std::string& name) : CoroActionNode(name, {}) {}
  NodeStatus tick() override {
    for (int i = 0; i < 2; ++i) setStatusRunningAndYield();
    return NodeStatus::SUCCESS;
  }
};

class Throw : public SyncActionNode {
 public:
  explicit Throw(const std::string& name) : SyncActionNode(name, {}) {}
  NodeStatus tick() override {
    if (throws) throw std::runtime_error("it is broken");
    return NodeStatus::SUCCESS;
  }
  bool throws = true;
};

// Derived, as for a tree.
class Loud : public SequenceNode {
 public:
  explicit Loud(const std::string& name) : SequenceNode(name) {}
  void halt() override {
    std::cout << name() << " is halted" << std::endl;
    SequenceNode::halt();
  }
};

void show_statuses() {
  Loud root("root");
  Yield yield("yield");
  InverterNode inverter("inverter");
  Block block("block");
  root.addChild(&yield);
  root.addChild(&inverter);
  inverter.setChild(&block);

  printTreeRecursively(&root);
  std::vector<TreeNode::StatusChangeSubscriber> subscribers;
  applyRecursiveVisitor(&root, [&subscribers](TreeNode* node) {
    subscribers.push_back(node->subscribeToStatusChange(
        [](TimePoint, const TreeNode& it, NodeStatus before, NodeStatus now) {
          std::cout << it.name() << " " << before << " " << now << std::endl;
        }));
  });
  for (int i = 0; i < 3; ++i) std::cout << root.executeTick() << std::endl;
  root.haltNode();
  for (int i = 0; i < 2; ++i) root.executeTick();
  block.is_over = true;
  NodeStatus result = root.executeTick();
  while (result == NodeStatus::RUNNING) result = root.executeTick();
  const TreeNode* const constant = &root;
  applyRecursiveVisitor(constant, [](const TreeNode* node) {
    std::cout << node->registrationName() << ":" << node->status() << " ";
  });
  std::cout << std::endl;
}

void show_hooks() {
  SequenceNode root("root");
  Act a("a", "F"), b("b", "S");
  root.addChild(&a);
  root.addChild(&b);
  a.setPreTickFunction([](TreeNode&) { return NodeStatus::SUCCESS; });
  b.setPostTickFunction([](TreeNode&, NodeStatus status) {
    std::cout << "b: " << status << std::endl;
    return NodeStatus::FAILURE;
  });
  calls.clear();
  const NodeStatus result = root.executeTick();
  std::cout << result << " " << calls.size() << std::endl;
}

// What is thrown names the node, and the next ticks go on as if nothing had been.
void show_errors() {
  SequenceNode root("root");
  Act a("a", "SR");
  Throw broken("broken");
  ParallelNode both("both");
  root.addChild(&both);
  both.addChild(&a);
  both.addChild(&broken);
  for (int i = 0; i < 2; ++i) {
    try {
      root.executeTick();
    } catch (const NodeExecutionError& error) {
      std::cout << error.what() << ", " << root.status() << " " << a.status() << " "
                << broken.status() << std::endl;
    }
  }
  broken.throws = false;
  const NodeStatus result = root.executeTick();
  std::cout << result << " " << a.status() << std::endl;
}

template <class Call>
void refused(Call call) {
  try {
    call();
    std::cout << "it is not refused" << std::endl;
  } catch (const BehaviorTreeException& error) {
    std::cout << error.what() << std::endl;
  }
}

void show_refusals() {
  InverterNode inverter("inverter");
  SequenceNode row("row");
  IfThenElseNode branch("branch");
  ParallelNode both("both");
  both.setSuccessThreshold(2);
  refused([&] { inverter.executeTick(); });
  refused([&] { inverter.setChild(nullptr); });
  refused([&] { row.addChild(&row); });
  inverter.setChild(&row);
  refused([&] { inverter.setChild(&branch); });
  refused([&] { branch.executeTick(); });
  refused([&] { both.executeTick(); });
  refused([&] { SwitchNode<2>("choice", {}).executeTick(); });
  refused([&] { applyRecursiveVisitor(static_cast<TreeNode*>(nullptr), [](TreeNode*) {}); });
}

// The same functions over a tree, from any of its nodes.
void show_tree() {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Loud>("Loud");
  Tree tree = factory.createTreeFromText(
      R"(<root BTCPP_format="4"><BehaviorTree ID="Main">
           <Sequence><Loud><Inverter><AlwaysSuccess/></Inverter></Loud><AlwaysFailure/></Sequence>
         </BehaviorTree></root>)");
  const auto show = [](TreeNode* node) { std::cout << node->name() << " "; };
  applyRecursiveVisitor(tree.rootNode(), show);
  std::cout << std::endl;
  applyRecursiveVisitor(tree.subtrees.front()->nodes.at(1).get(), show);
  std::cout << std::endl;
}

}  // namespace

int main() {
  check_laws();
  show_statuses();
  show_hooks();
  show_errors();
  show_refusals();
  show_tree();
  return 0;
}
