// Trees in a program: BehaviorTreeFactory::createTreeFromFile and what it returns, over
// lockstep/runtime.h. Included by bt_factory.h where all of lockstep is installed.
#pragma once

#include <lockstep/runtime.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"
#include "behaviortree_cpp/lockstep/program_nodes.h"
#include "behaviortree_cpp/utils/wakeup_signal.hpp"
#include "behaviortree_cpp/utils/wildcards.hpp"

namespace BT {
namespace lockstep_detail {

// "tree.xml:3:5: ", as much of it as is known.
inline std::string place_of(const lockstep_diagnostic& it) {
  if (*it.file == '\0') return {};
  std::string place = StrCat(it.file, ":");
  if (it.line != 0) place += std::to_string(it.line) + ":";
  if (it.column != 0) place += std::to_string(it.column) + ":";
  return place + " ";
}

// What went wrong, with its places.
inline std::string project_errors(lockstep_project* project) {
  std::string text = lockstep_last_error();
  for (std::uint32_t i = 0; i < lockstep_project_diagnostic_count(project); ++i) {
    lockstep_diagnostic it{};
    it.struct_size = sizeof it;
    if (!lockstep_project_diagnostic(project, i, &it) || it.severity != LOCKSTEP_ERROR) continue;
    text += StrCat("\n", place_of(it), it.message, *it.hint == '\0' ? "" : "; ", it.hint);
  }
  return text;
}

// One tree that can be ticked, with its leaves.
class Program : public EntryStore {
 public:
  struct Source {
    std::shared_ptr<PluginTable> nodes;
    std::vector<std::string> plugins;
    std::string text, file, main_tree;  // one of the first two
  };

  explicit Program(Source source) : source_(std::move(source)) {
    if (project_ == nullptr) throw RuntimeError(lockstep_last_error());
    const Making scope(*source_.nodes);
    load();
    places_ = std::make_unique<const NodePlaces>(project_.get());
    source_.nodes->numbers.clear();
    source_.nodes->made.clear();
    for (const NodePlace& it : places_->nodes) source_.nodes->numbers[it.own_path] = it.number;
    lockstep_run_options options{};
    options.struct_size = sizeof options;
    options.tick_period = 0.01;
    run_.reset(lockstep_run_new(project_.get(), &options));
    if (run_ == nullptr) throw RuntimeError(lockstep_last_error());
    for (std::uint32_t i = 0; i < places_->nodes.size(); ++i) nodes_.push_back(make_node(i));
    root_ = std::make_unique<ProgramNode>(*this, run_.get(), 0, *places_, nodes_.front()->type());
  }

  NodeStatus tick() {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - began_;
    const auto status = static_cast<NodeStatus>(lockstep_run_tick(run_.get(), since.count()));
    for (std::size_t i = 0; i < observers_.size(); ++i) {
      if (const auto observe = observers_[i].lock()) (*observe)();
    }
    throw_fault();
    return status;
  }
  void halt() { lockstep_run_halt(run_.get()); }

  lockstep_project* project() const { return project_.get(); }
  lockstep_run* run() const { return run_.get(); }
  // As long as the result lives.
  std::shared_ptr<std::function<void()>> observe(std::function<void()> after_tick) {
    auto observer = std::make_shared<std::function<void()>>(std::move(after_tick));
    observers_.push_back(observer);
    return observer;
  }
  const NodePlaces& places() const { return *places_; }
  // In the order of the tree: objects of the program's classes, or what stands for others.
  const std::vector<TreeNode::Ptr>& nodes() const { return nodes_; }
  TreeNode* root() const { return root_.get(); }
  // After the last tick.
  NodeStatus status_of(std::uint32_t index) const {
    lockstep_node_state state{};
    state.struct_size = sizeof state;
    if (!lockstep_run_node(run_.get(), index, &state)) return NodeStatus::IDLE;
    return static_cast<NodeStatus>(state.status);
  }

  bool get(const std::string& key, Any& value) const override {
    const char* const name = key.c_str();
    bool flag = false;
    std::int64_t whole = 0;
    double real = 0;
    if (lockstep_run_get_bool(run_.get(), name, &flag)) {
      value = Any(flag);
    } else if (lockstep_run_get_int(run_.get(), name, &whole)) {
      value = Any(whole);
    } else if (lockstep_run_get_double(run_.get(), name, &real)) {
      value = Any(real);
    } else if (const char* const text = lockstep_run_get_text(run_.get(), name)) {
      value = Any(text);
    } else {
      return false;
    }
    return true;
  }
  bool set(const std::string& key, const Any& value) override {
    const char* const name = key.c_str();
    if (value.isString()) {
      return lockstep_run_set_text(run_.get(), name, value.cast<std::string>().c_str());
    }
    const auto whole = value.tryCast<std::int64_t>();
    const auto real = value.tryCast<double>();
    if (value.isType<bool>() && lockstep_run_set_bool(run_.get(), name, value.cast<bool>())) {
      return true;
    }
    if (whole && lockstep_run_set_int(run_.get(), name, *whole)) return true;
    if (real && lockstep_run_set_double(run_.get(), name, *real)) return true;
    const auto json = toJsonString(value);  // of an object
    return json && lockstep_run_set_text(run_.get(), name, json->c_str());
  }

 private:
  void load() {
    const lockstep_plugin& leaves = source_.nodes->describe("program", table_extension);
    bool good = leaves.leaf_type_count == 0 || lockstep_project_add_leaves(project_.get(), &leaves);
    for (const std::string& plugin : source_.plugins) {
      good = good && lockstep_project_add_plugin(project_.get(), plugin.c_str());
    }
    if (!source_.main_tree.empty()) {
      good = good && lockstep_project_set_main_tree(project_.get(), source_.main_tree.c_str());
    }
    if (good && !source_.file.empty()) {
      good = lockstep_project_load_file(project_.get(), source_.file.c_str());
    } else if (good) {
      good = lockstep_project_load_text(project_.get(), "text", source_.text.data(),
                                        source_.text.size());
    }
    if (!good) throw RuntimeError(project_errors(project_.get()));
  }

  struct FreeProject {
    void operator()(lockstep_project* project) const { lockstep_project_free(project); }
  };
  struct FreeRun {
    void operator()(lockstep_run* run) const { lockstep_run_free(run); }
  };

  void throw_fault() {
    std::uint32_t index = 0;
    const char* const fault = lockstep_run_fault(run_.get(), &index);
    if (fault == nullptr) return;
    std::string text = fault;
    halt();
    if (index >= places_->nodes.size()) throw RuntimeError(text);
    const NodePlace& node = places_->nodes[index];
    const std::string path = node.own_path + ": ";
    if (StartWith(text, path)) text.erase(0, path.size());
    throw NodeExecutionError({node.name, node.number.path, node.id}, text);
  }

  TreeNode::Ptr make_node(std::uint32_t index) {
    const NodePlace& place = places_->nodes[index];
    const auto made = source_.nodes->made.find(place.own_path);
    if (made != source_.nodes->made.end()) return {made->second, [](TreeNode*) {}};
    const auto known = source_.nodes->manifests().find(place.id);
    const NodeType type =
        known == source_.nodes->manifests().end() ? type_of_id(place.id) : known->second.type;
    return std::make_shared<ProgramNode>(*this, run_.get(), index, *places_, type);
  }

  Source source_;  // outlives the run
  std::unique_ptr<lockstep_project, FreeProject> project_{lockstep_project_new()};
  std::unique_ptr<lockstep_run, FreeRun> run_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::vector<std::weak_ptr<std::function<void()>>> observers_;
  std::unique_ptr<const NodePlaces> places_;
  std::vector<TreeNode::Ptr> nodes_;
  std::unique_ptr<ProgramNode> root_;
};

// The entries of a SubTree.
class SubtreeEntries : public EntryStore {
 public:
  SubtreeEntries(std::shared_ptr<Program> program, std::string prefix)
      : program_(std::move(program)), prefix_(std::move(prefix)) {}
  bool get(const std::string& key, Any& value) const override {
    return program_->get(prefix_ + key, value);
  }
  bool set(const std::string& key, const Any& value) override {
    return program_->set(prefix_ + key, value);
  }

 private:
  std::shared_ptr<Program> program_;
  std::string prefix_;
};

}  // namespace lockstep_detail

class Tree {
 public:
  struct Subtree {
    using Ptr = std::shared_ptr<Subtree>;
    std::vector<TreeNode::Ptr> nodes;
    Blackboard::Ptr blackboard;
    std::string instance_name;  // "" of the main tree
    std::string tree_ID;        // the name of the SubTree
  };
  std::vector<Subtree::Ptr> subtrees;  // the main tree first

  Tree() = default;
  Tree(std::shared_ptr<lockstep_detail::Program> program, Blackboard::Ptr blackboard)
      : program_(std::move(program)), blackboard_(std::move(blackboard)) {
    blackboard_->lockstep_attach(program_);
    for (const lockstep_detail::SubtreePlace& it : program_->places().subtrees) {
      Blackboard::Ptr entries = subtrees.empty() ? blackboard_ : Blackboard::create();
      if (!subtrees.empty()) {
        entries->lockstep_attach(
            std::make_shared<lockstep_detail::SubtreeEntries>(program_, it.entries));
      }
      subtrees.push_back(
          std::make_shared<Subtree>(Subtree{{}, std::move(entries), it.path, it.name}));
    }
    const auto& nodes = program_->nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      subtrees[program_->places().nodes[i].subtree]->nodes.push_back(nodes[i]);
    }
  }

  // One period: the tree is ticked again while a node asks for it.
  NodeStatus tickOnce() { return lockstep_program().tick(); }
  NodeStatus tickExactlyOnce() { return lockstep_program().tick(); }
  NodeStatus tickWhileRunning(
      std::chrono::milliseconds sleep_time = std::chrono::milliseconds(10)) {
    NodeStatus status = tickOnce();
    while (status == NodeStatus::RUNNING) {
      sleep(sleep_time);
      status = tickOnce();
    }
    return status;
  }
  void haltTree() { lockstep_program().halt(); }
  // True: emitWakeUpSignal() has ended it.
  template <class Rep, class Period>
  bool sleep(std::chrono::duration<Rep, Period> duration) {
    return wake_up_->waitFor(std::chrono::duration_cast<std::chrono::microseconds>(duration));
  }
  // From any thread.
  void emitWakeUpSignal() { wake_up_->emitSignal(); }
  [[nodiscard]] std::shared_ptr<WakeUpSignal> wakeUpSignal() const { return wake_up_; }
  // The entries of the main tree: numbers, texts, and objects as texts.
  Blackboard::Ptr rootBlackboard() { return blackboard_; }

  // It stands for the whole tree: haltNode() halts it.
  [[nodiscard]] TreeNode* rootNode() const { return lockstep_program().root(); }
  // A program's own nodes are the objects that its classes made; others have a name, a path, a type
  // and a status.
  void applyVisitor(const std::function<void(const TreeNode*)>& visitor) const {
    for (const auto& node : lockstep_program().nodes()) visitor(node.get());
  }
  void applyVisitor(const std::function<void(TreeNode*)>& visitor) {
    for (const auto& node : lockstep_program().nodes()) visitor(node.get());
  }
  template <class Node = TreeNode>
  [[nodiscard]] std::vector<const TreeNode*> getNodesByPath(StringView pattern) const {
    std::vector<const TreeNode*> found;
    for (const auto& node : lockstep_program().nodes()) {
      if (dynamic_cast<const Node*>(node.get()) == nullptr) continue;
      if (wildcards_match(node->fullPath(), pattern)) found.push_back(node.get());
    }
    return found;
  }

  lockstep_detail::Program& lockstep_program() const {
    if (program_ == nullptr) throw LogicError("this BT::Tree is empty");
    return *program_;
  }

 private:
  std::shared_ptr<lockstep_detail::Program> program_;
  Blackboard::Ptr blackboard_;
  std::shared_ptr<WakeUpSignal> wake_up_ = std::make_shared<WakeUpSignal>();
};

template <class AnyTree>
std::vector<Blackboard::Ptr> BlackboardBackup(const AnyTree&) {
  static_assert(sizeof(AnyTree) == 0,
                "lockstep keeps no backups of a blackboard: rootBlackboard() reads and sets its "
                "entries one by one");
  return {};
}
template <class AnyTree>
void BlackboardRestore(const std::vector<Blackboard::Ptr>& backup, AnyTree& tree) {
  BlackboardBackup(tree);
  static_cast<void>(backup);
}
template <class AnyTree>
std::string ExportTreeToJSON(const AnyTree&) {
  static_assert(sizeof(AnyTree) == 0,
                "lockstep has no ExportTreeToJSON: 'lockstep run --record run.jsonl' records the "
                "entries of a run");
  return {};
}

// The names of all nodes, each below its parent.
inline void printTreeRecursively(const TreeNode* root, std::ostream& out = std::cout) {
  const auto* const node = dynamic_cast<const lockstep_detail::ProgramNode*>(root);
  if (node == nullptr || node->index() != 0) throw LogicError("it is not the root of a BT::Tree");
  std::vector<std::size_t> depth;
  out << "----------------" << std::endl;
  for (const lockstep_detail::NodePlace& it : node->places().nodes) {
    depth.push_back(depth.empty() ? 0 : depth[it.parent] + 1);
    out << std::string(3 * depth.back(), ' ') << it.name << std::endl;
  }
  out << "----------------" << std::endl;
}

}  // namespace BT
