// A server that runs trees by name, shaped like BehaviorTree.ROS2's TreeExecutionServer.
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <set>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/bt_cout_logger.h"
#ifdef GROOT
#include "behaviortree_cpp/loggers/groot2_publisher.h"
#endif

struct Goal {
  std::string target_tree, payload;
};
struct Result {
  bool aborted = false, cancelled = false;
  BT::NodeStatus status = BT::NodeStatus::IDLE;
  std::string message;
};

class TreeExecutionServer {
 public:
  explicit TreeExecutionServer(std::filesystem::path folder)
      : folder_(std::move(folder)), global_blackboard_(BT::Blackboard::create()) {}
  virtual ~TreeExecutionServer() = default;
  void executeRegistration() {
    factory_.clearRegisteredBehaviorTrees();
    registerNodesIntoFactory(factory_);
    std::set<std::filesystem::path> files;
    for (const auto& it : std::filesystem::directory_iterator(folder_)) files.insert(it.path());
    for (const auto& it : files)
      if (it.extension() == ".so") factory_.registerFromPlugin(it.string());
    for (const auto& it : files) {
      if (it.extension() != ".xml") continue;
      try {
        factory_.registerBehaviorTreeFromFile(it.string());
      } catch (const std::exception& e) {
        std::cout << "cannot load " << it.filename().string() << std::endl;
      }
    }
    for (const auto& [name, manifest] : factory_.manifests())
      if (factory_.builtinNodes().count(name) == 0) (void)manifest;
    auto trees = factory_.registeredBehaviorTrees();
    std::sort(trees.begin(), trees.end());
    for (const auto& it : trees) std::cout << "tree " << it << std::endl;
  }
  Result execute(const Goal& goal, const std::function<bool(int)>& is_cancelling = {}) {
    Result result;
    try {
      auto root_blackboard = BT::Blackboard::create(global_blackboard_);
      tree_.emplace(factory_.createTree(goal.target_tree, root_blackboard));
      goal_payload_ = goal.payload;
      onTreeCreated(*tree_);
      const auto period = std::chrono::milliseconds(1);
      auto loop_deadline = std::chrono::steady_clock::now() + period;
      BT::NodeStatus status = BT::NodeStatus::RUNNING;
      int loops = 0;
      while (status == BT::NodeStatus::RUNNING) {
        if (is_cancelling && is_cancelling(loops)) {
          tree_->haltTree();
          onTreeExecutionCompleted(status, true);
          result.cancelled = true;
          result.message = "cancelled";
          result.status = status;
          return result;
        }
        status = tree_->tickExactlyOnce();
        if (const auto early = onLoopAfterTick(status)) {
          tree_->haltTree();
          status = *early;
        }
        ++loops;
        const auto now = std::chrono::steady_clock::now();
        if (now < loop_deadline)
          tree_->sleep(
              std::chrono::duration_cast<std::chrono::system_clock::duration>(loop_deadline - now));
        loop_deadline += period;
      }
      result.status = status;
    } catch (const std::exception& e) {
      result.aborted = true;
      result.message = e.what();
      return result;
    }
    if (const auto message = onTreeExecutionCompleted(result.status, false))
      result.message = *message;
    return result;
  }
  BT::Blackboard::Ptr globalBlackboard() { return global_blackboard_; }
  BT::BehaviorTreeFactory& factory() { return factory_; }
  BT::Tree& tree() { return *tree_; }
  const std::string& goalPayload() const { return goal_payload_; }

 protected:
  virtual void registerNodesIntoFactory(BT::BehaviorTreeFactory&) {}
  virtual void onTreeCreated(BT::Tree&) {}
  virtual std::optional<BT::NodeStatus> onLoopAfterTick(BT::NodeStatus) { return std::nullopt; }
  virtual std::optional<std::string> onTreeExecutionCompleted(BT::NodeStatus, bool) {
    return std::nullopt;
  }

 private:
  std::filesystem::path folder_;
  BT::BehaviorTreeFactory factory_;
  BT::Blackboard::Ptr global_blackboard_;
  std::string goal_payload_;
  std::optional<BT::Tree> tree_;
};

class Count : public BT::StatefulActionNode {
 public:
  Count(const std::string& name, const BT::NodeConfig& config, std::shared_ptr<int> total)
      : StatefulActionNode(name, config), total_(std::move(total)) {}
  static BT::PortsList providedPorts() {
    return {BT::InputPort<int>("to", 3, "ticks"), BT::OutputPort<int>("done")};
  }
  BT::NodeStatus onStart() override {
    left_ = getInput<int>("to").value();
    return onRunning();
  }
  BT::NodeStatus onRunning() override {
    ++*total_;
    setOutput("done", *total_);
    return left_-- > 0 ? BT::NodeStatus::RUNNING : BT::NodeStatus::SUCCESS;
  }
  void onHalted() override { std::cout << "  " << name() << " halted" << std::endl; }

 private:
  std::shared_ptr<int> total_;
  int left_ = 0;
};
class Throws : public BT::SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus tick() override { throw BT::RuntimeError("no map"); }
};
class Again : public BT::SyncActionNode {  // asks for another tick in this period
 public:
  using SyncActionNode::SyncActionNode;
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus tick() override {
    emitWakeUpSignal();
    return BT::NodeStatus::SUCCESS;
  }
};

class MyServer : public TreeExecutionServer {
 public:
  using TreeExecutionServer::TreeExecutionServer;
  int max_loops = 100;

 private:
  void registerNodesIntoFactory(BT::BehaviorTreeFactory& factory) override {
    factory.registerNodeType<Count>("Count", total_);
    factory.registerNodeType<Throws>("Throws");
    factory.registerNodeType<Again>("Again");
  }
  void onTreeCreated(BT::Tree& tree) override {
    loops_ = 0;
    logger_ = std::make_shared<BT::StdCoutLogger>(tree);
    logger_->setEnabled(false);
    tree.rootBlackboard()->set("payload", goalPayload());
#ifdef GROOT
    groot_ = std::make_shared<BT::Groot2Publisher>(tree, 1777);
#endif
    int nodes = 0;
    tree.applyVisitor([&nodes](BT::TreeNode*) { ++nodes; });
    std::cout << "  created with " << nodes << " nodes" << std::endl;
  }
  std::optional<BT::NodeStatus> onLoopAfterTick(BT::NodeStatus) override {
    return ++loops_ >= max_loops ? std::optional(BT::NodeStatus::FAILURE) : std::nullopt;
  }
  std::optional<std::string> onTreeExecutionCompleted(BT::NodeStatus status,
                                                      bool was_cancelled) override {
    logger_.reset();
    std::cout << "  completed: " << toStr(status) << (was_cancelled ? " cancelled" : "")
              << " after " << loops_ << " loops" << std::endl;
    std::cout << "  global total: " << globalBlackboard()->get<int>("total") << std::endl;
    std::cout << "  payload: " << tree().rootBlackboard()->get<std::string>("payload") << std::endl;
    return "done";
  }
  std::shared_ptr<int> total_ = std::make_shared<int>(0);
  std::shared_ptr<BT::StdCoutLogger> logger_;
#ifdef GROOT
  std::shared_ptr<BT::Groot2Publisher> groot_;
#endif
  int loops_ = 0;
};

int main() {
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("server" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
  std::filesystem::create_directory(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write(
      "a.xml",
      R"(<root BTCPP_format="4"><BehaviorTree ID="Short"><Sequence><Count to="2" done="{@total}"/><SubTree ID="Part" _autoremap="true"/></Sequence></BehaviorTree><BehaviorTree ID="Endless"><KeepRunningUntilFailure><Count to="1" done="{own}"/></KeepRunningUntilFailure></BehaviorTree></root>)");
  write(
      "b.xml",
      R"(<root BTCPP_format="4"><BehaviorTree ID="Part"><Script code="seen := payload"/></BehaviorTree><BehaviorTree ID="Faulty"><Throws/></BehaviorTree><BehaviorTree ID="Eager"><KeepRunningUntilFailure><Again/></KeepRunningUntilFailure></BehaviorTree></root>)");
  MyServer server(folder);
  server.globalBlackboard()->set("total", 0);
  server.executeRegistration();
  const auto tell = [](const std::string& what, const Result& it) {
    std::cout << what << ": " << toStr(it.status) << (it.aborted ? " aborted" : "")
              << (it.cancelled ? " cancelled" : "") << (it.aborted ? "" : " " + it.message)
              << std::endl;
  };
  tell("short", server.execute({"Short", "one"}));
  tell("short again", server.execute({"Short", "two"}));
  tell("endless", server.execute({"Endless", "three"}, [](int loops) { return loops == 5; }));
  server.max_loops = 4;
  tell("limited", server.execute({"Endless", "four"}));
  tell("eager", server.execute({"Eager", "five"}));
  tell("faulty", server.execute({"Faulty", "six"}));
  tell("unknown", server.execute({"Nobody", "seven"}));
  std::filesystem::remove_all(folder);
  return 0;
}
