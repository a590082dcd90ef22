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

namespace BT {
namespace detail {

template <class>
inline constexpr bool is_absent = false;

// What went wrong, with its places.
inline std::string project_errors(lockstep_project* project) {
  std::string text = lockstep_last_error();
  for (std::uint32_t i = 0; i < lockstep_project_diagnostic_count(project); ++i) {
    lockstep_diagnostic it{};
    it.struct_size = sizeof it;
    if (!lockstep_project_diagnostic(project, i, &it) || it.severity != LOCKSTEP_ERROR) continue;
    text += StrCat("\n", it.file, ":", std::to_string(it.line), ":", std::to_string(it.column),
                   ": ", it.message, *it.hint == '\0' ? "" : "; ", it.hint);
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
    lockstep_run_options options{};
    options.struct_size = sizeof options;
    options.tick_period = 0.01;
    run_.reset(lockstep_run_new(project_.get(), &options));
    if (run_ == nullptr) throw RuntimeError(lockstep_last_error());
  }

  NodeStatus tick() {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - began_;
    const auto status = static_cast<NodeStatus>(lockstep_run_tick(run_.get(), since.count()));
    for (const auto& observe : observers_) observe();
    if (const char* const fault = lockstep_run_fault(run_.get(), nullptr)) {
      const std::string text = fault;
      halt();
      throw RuntimeError(text);
    }
    return status;
  }
  void halt() { lockstep_run_halt(run_.get()); }

  lockstep_project* project() const { return project_.get(); }
  lockstep_run* run() const { return run_.get(); }
  void observe(std::function<void()> after_tick) { observers_.push_back(std::move(after_tick)); }

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
    const auto text = value.tryCast<std::string>();
    return text && lockstep_run_set_text(run_.get(), name, text->c_str());
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

  Source source_;  // outlives the run
  std::unique_ptr<lockstep_project, FreeProject> project_{lockstep_project_new()};
  std::unique_ptr<lockstep_run, FreeRun> run_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::vector<std::function<void()>> observers_;
};

// The root of a tree. It is no object here.
struct Root {
  const Program* program;

  template <class Node = TreeNode>
  Node* operator->() const {
    static_assert(is_absent<Node>,
                  "lockstep has no nodes of a tree as objects: lockstep_project_node() of "
                  "lockstep/runtime.h lists them, and lockstep show prints a tree");
    return nullptr;
  }
};

}  // namespace detail

class Tree {
 public:
  Tree() = default;
  Tree(std::shared_ptr<detail::Program> program, Blackboard::Ptr blackboard)
      : program_(std::move(program)), blackboard_(std::move(blackboard)) {
    blackboard_->attach(program_);
  }

  // One period: the tree is ticked again while a node asks for it.
  NodeStatus tickOnce() { return program().tick(); }
  NodeStatus tickExactlyOnce() { return program().tick(); }
  NodeStatus tickWhileRunning(
      std::chrono::milliseconds sleep_time = std::chrono::milliseconds(10)) {
    NodeStatus status = tickOnce();
    while (status == NodeStatus::RUNNING) {
      sleep(sleep_time);
      status = tickOnce();
    }
    return status;
  }
  void haltTree() { program().halt(); }
  // False: nothing has ended it.
  template <class Rep, class Period>
  bool sleep(std::chrono::duration<Rep, Period> duration) {
    std::this_thread::sleep_for(duration);
    return false;
  }
  // The entries of the main tree: numbers, texts, and objects as texts.
  Blackboard::Ptr rootBlackboard() { return blackboard_; }

  // For printTreeRecursively.
  detail::Root rootNode() const { return {&program()}; }
  template <class Visitor>
  void applyVisitor(const Visitor&) const {
    static_assert(detail::is_absent<Visitor>,
                  "lockstep has no nodes of a tree as objects: lockstep_project_node() of "
                  "lockstep/runtime.h lists them");
  }

  detail::Program& program() const {
    if (program_ == nullptr) throw LogicError("this BT::Tree is empty");
    return *program_;
  }

 private:
  std::shared_ptr<detail::Program> program_;
  Blackboard::Ptr blackboard_;
};

// The names of all nodes, each below its parent.
inline void printTreeRecursively(const detail::Root& root, std::ostream& out = std::cout) {
  std::vector<std::size_t> depth;
  for (std::uint32_t i = 0; i < lockstep_project_node_count(root.program->project()); ++i) {
    lockstep_node node{};
    node.struct_size = sizeof node;
    if (!lockstep_project_node(root.program->project(), i, &node)) return;
    depth.push_back(node.parent == i ? 0 : depth[node.parent] + 1);
    out << std::string(3 * depth.back(), ' ') << node.name << std::endl;
  }
}

}  // namespace BT
