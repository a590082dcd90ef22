// A tree of a program over lockstep/runtime.h, and the functions of tree.h.
#pragma once

#include <lockstep/runtime.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"
#include "behaviortree_cpp/lockstep/program_nodes.h"
#include "behaviortree_cpp/lockstep/stand_in.h"
#include "behaviortree_cpp/lockstep/tree.h"
#include "behaviortree_cpp/lockstep/tree_watch.h"
#include "behaviortree_cpp/utils/wakeup_signal.hpp"

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

// All errors of a project, with their places.
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
class Program : public NodeTree, public std::enable_shared_from_this<Program> {
 public:
  struct Source {
    std::shared_ptr<PluginTable> nodes;
    std::vector<std::string> plugins;
    std::string text, file, main_tree;     // one of the first two
    Blackboard::Ptr blackboard = nullptr;  // of the main tree
    std::shared_ptr<const Outline> outline = nullptr;
  };

  explicit Program(Source source) : NodeTree({start_watch, is_result_over, halt_for, visit_from}), source_(std::move(source)) {
    if (project_ == nullptr) throw RuntimeError(lockstep_last_error());
    const Making scope(*source_.nodes);
    load();
    source_.nodes->numbers.clear();
    source_.nodes->made.clear();
    source_.nodes->tests.clear();
    if (source_.outline != nullptr) source_.nodes->tests = source_.outline->tests;
    places_ =
        std::make_unique<const NodePlaces>(project_.get(), source_.outline.get(), *source_.nodes);
    for (const NodePlace& it : places_->nodes) source_.nodes->numbers[it.own_path] = it.number;
    lockstep_run_options options{};
    options.struct_size = sizeof options;
    options.tick_period = 0.01;
    options.prepare = prepare;
    options.user = this;
    options.wake = [](void* user) { static_cast<Program*>(user)->wake_up_->emitSignal(); };
    run_.reset(lockstep_run_new(project_.get(), &options));
    if (run_ == nullptr) throw RuntimeError(lockstep_last_error());
    for (std::uint32_t i = 0; i < places_->nodes.size(); ++i) {
      nodes_.push_back(make_node(i));
      auto* const parent = dynamic_cast<StandsIn*>(nodes_[places_->nodes[i].parent].get());
      if (i != 0 && parent != nullptr) parent->adopt(*nodes_[i]);
    }
    watch_ = std::make_unique<TreeWatch>(run_.get(), *places_, nodes_);
    bool is_watched = false;  // a node may subscribe in its constructor
    for (const TreeNode::Ptr& it : nodes_) {
      it->lockstep_tree_ = this;
      it->lockstep_index_ = static_cast<std::uint32_t>(&it - nodes_.data());
      is_watched = is_watched || it->lockstep_watch_ != nullptr;
    }
    if (is_watched) watch_->begin();
  }

  ~Program() {
    is_busy_ = true;
    lockstep_run_halt(run_.get());
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Once, or again while a node asks for it.
  NodeStatus tick(bool exactly_once) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    source_.blackboard->lockstep_take_from_parents();
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - began_;
    const bool is_inner = is_busy_.exchange(true);
    const auto status = static_cast<NodeStatus>(
        (exactly_once ? lockstep_run_tick_once : lockstep_run_tick)(run_.get(), since.count()));
    is_busy_ = is_inner;
    source_.blackboard->lockstep_refresh();
    if (watch_->has_thrown()) {
      halt_all();
      lockstep_run_recover(run_.get());
      watch_->rethrow();
    }
    throw_fault();
    return status;
  }
  // All that runs; then it throws what one has thrown. From any thread: a tick ends before that.
  void halt() {
    ++halts_;
    if (is_looping_) wake_up_->emitSignal();
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    halt_all();
    throw_fault();
  }

  // Ticks until the tree has completed or is halted, also by another thread: then IDLE.
  template <class Sleep>
  NodeStatus tick_while_running(Sleep sleep) {
    const unsigned halts = halts_;
    is_looping_ = true;
    const Looping looping{is_looping_};
    NodeStatus status = tick(false);
    while (status == NodeStatus::RUNNING && halts_ == halts) {
      sleep();
      if (halts_ == halts) status = tick(false);
    }
    if (status != NodeStatus::RUNNING) return status;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    halt_all();  // a node that was ticked may have asked for it
    throw_fault();
    return NodeStatus::IDLE;
  }

  // Ends a sleep between two ticks; nodes emit it from any thread.
  const std::shared_ptr<WakeUpSignal>& wake_up() const { return wake_up_; }
  lockstep_project* project() const { return project_.get(); }
  lockstep_run* run() const { return run_.get(); }
  const NodePlaces& places() const { return *places_; }
  // The outline of the documents; null: they could not be read.
  const Outline* outline() const { return source_.outline.get(); }
  const std::shared_ptr<PluginTable>& table() const { return source_.nodes; }
  // In the order of the tree: objects of the program's classes, or what stands for others.
  const std::vector<TreeNode::Ptr>& nodes() const { return nodes_; }
  TreeNode* root() const { return nodes_.front().get(); }
  Blackboard::Ptr blackboard_of(std::size_t subtree) const {
    BoardHandle root(*lockstep_boards_table(), lockstep_run_board(run_.get(), 0));
    return Blackboard::lockstep_of(BoardFamily::of(std::move(root)),
                                   static_cast<std::uint32_t>(subtree));
  }
  // The status of a node that is no object of the program.
  NodeStatus status_of(std::uint32_t index) const {
    if (watch_ != nullptr && watch_->is_on()) {
      return nodes_[index]->lockstep_status_.load(std::memory_order_acquire);
    }
    const NodeStatus status = engine_status(index);
    return status == NodeStatus::SKIPPED ? NodeStatus::IDLE : status;
  }

 private:
  // What NodeTree calls.
  static void start_watch(NodeTree& tree) {
    const Program& program = static_cast<Program&>(tree);
    if (program.watch_ != nullptr) program.watch_->begin();
  }
  static bool is_result_over(const NodeTree& tree, const TreeNode& node) {
    const Program& program = static_cast<const Program&>(tree);
    if (program.is_busy_ || program.watch_ == nullptr || program.watch_->is_on()) return false;
    const std::uint32_t index = node.lockstep_index_;
    const std::uint32_t parent = program.places_->nodes[index].parent;
    return parent == index || program.engine_status(parent) != NodeStatus::RUNNING;
  }
  static bool halt_for(NodeTree& tree, const TreeNode& node) {
    Program& program = static_cast<Program&>(tree);
    if (program.is_busy_) return false;
    if (node.lockstep_index_ != 0) {
      throw LogicError("node '", node.name(), "' is halted by its tree only: BT::Tree::haltTree()");
    }
    program.halt();
    return true;
  }
  static void visit_from(const NodeTree& tree, const TreeNode& first, const Visitor& visitor) {
    const Program& program = static_cast<const Program&>(tree);
    const std::uint32_t begin = first.lockstep_index_;
    std::vector<std::size_t> depths;  // of the nodes below: those that follow, until one is not
    for (std::uint32_t i = begin; i < program.nodes_.size(); ++i) {
      const std::uint32_t parent = program.places_->nodes[i].parent;
      if (i != begin && parent < begin) return;
      depths.push_back(i == begin ? 0 : depths[parent - begin] + 1);
      visitor(program.nodes_[i].get(), depths.back());
    }
  }

  // The blackboard is that of the run, before its nodes are made.
  static void prepare(void* user, lockstep_board* main) {
    const Program& program = *static_cast<const Program*>(user);
    const lockstep_boards& table = *lockstep_boards_table();
    Blackboard& board = *program.source_.blackboard;
    board.lockstep_attach(BoardFamily::of({table, table.at(main, 0)}), 0);
    board.lockstep_give();
  }

  void load() {
    const lockstep_plugin& leaves = source_.nodes->describe("program", table_extension);
    lockstep_project_open_entries(project_.get(), source_.blackboard->parent() != nullptr);
    const bool is_empty = leaves.leaf_type_count == 0 && source_.nodes->words()->empty();
    bool good = is_empty || lockstep_project_add_leaves(project_.get(), &leaves);
    for (const std::string& plugin : source_.plugins) {
      good = good && lockstep_project_add_plugin(project_.get(), plugin.c_str());
    }
    if (groot_is_wanted) good = good && lockstep_project_show_groot2(project_.get());
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

  void halt_all() {
    const bool is_inner = is_busy_.exchange(true);
    lockstep_run_halt(run_.get());
    is_busy_ = is_inner;
    if (!is_inner) watch_->forget_all();
  }

  // The next tick begins the tree again.
  void throw_fault() {
    std::uint32_t index = 0;
    const char* const fault = lockstep_run_fault(run_.get(), &index);
    if (fault == nullptr) return;
    std::string text = fault;
    halt_all();
    lockstep_run_recover(run_.get());
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
    const TreeNodeManifest* const known = source_.nodes->manifest(place.id);
    const NodeType type = known == nullptr ? type_of_id(place.id) : known->type;
    return make_stand_in(*this, index, place, type);
  }

  NodeStatus engine_status(std::uint32_t index) const {
    lockstep_node_state state{};
    state.struct_size = sizeof state;
    if (!lockstep_run_node(run_.get(), index, &state)) return NodeStatus::IDLE;
    return static_cast<NodeStatus>(state.status);
  }

  struct Looping {
    std::atomic<bool>& is_looping;
    ~Looping() { is_looping = false; }
  };

  Source source_;  // outlives the run
  std::unique_ptr<lockstep_project, FreeProject> project_{lockstep_project_new()};
  const std::shared_ptr<WakeUpSignal> wake_up_ = std::make_shared<WakeUpSignal>();
  std::unique_ptr<const NodePlaces> places_;
  std::vector<TreeNode::Ptr> nodes_;
  std::unique_ptr<TreeWatch> watch_;
  std::recursive_mutex mutex_;  // held by the thread that ticks or halts it
  std::atomic<unsigned> halts_{0};
  std::atomic<bool> is_looping_{false};
  std::atomic<bool> is_busy_{false};  // it is ticked, or halted, or ends
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::unique_ptr<lockstep_run, FreeRun> run_;  // it ends before what it calls back
  // The blackboard has its entries for itself again before the run goes.
  struct Attachment {
    const Source& source;
    ~Attachment() { source.blackboard->lockstep_detach(); }
  };
  const Attachment attachment_{source_};
};

inline NodeStatus status_in(const Program& program, std::uint32_t index) {
  return program.status_of(index);
}
inline NodeStatus tick_root(Program& program) {
  return program.tick(true);
}

LOCKSTEP_BTCPP_INLINE const ManifestsOfTree::Map& ManifestsOfTree::map() const {
  static const Map kNone;
  return table_ == nullptr ? kNone : table_->manifests();
}

}  // namespace lockstep_detail

LOCKSTEP_BTCPP_INLINE Tree::Tree(std::shared_ptr<lockstep_detail::Program> program)
    : manifests(program->table()), program_(std::move(program)) {
  for (const lockstep_detail::SubtreePlace& it : program_->places().subtrees) {
    subtrees.push_back(
        std::make_shared<Subtree>(Subtree{{},
                                          program_->blackboard_of(subtrees.size()),
                                          it.path,
                                          it.tree_id.empty() ? it.name : it.tree_id}));
  }
  const auto& nodes = program_->nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    subtrees[program_->places().nodes[i].subtree]->nodes.push_back(nodes[i]);
  }
}

LOCKSTEP_BTCPP_INLINE lockstep_detail::Program& Tree::lockstep_program() const {
  if (program_ == nullptr) throw RuntimeError("this BT::Tree is empty");
  return *program_;
}
LOCKSTEP_BTCPP_INLINE const std::vector<TreeNode::Ptr>& Tree::lockstep_nodes() const {
  static const std::vector<TreeNode::Ptr> kNone;
  return program_ == nullptr ? kNone : program_->nodes();
}

LOCKSTEP_BTCPP_INLINE NodeStatus Tree::tickOnce() {
  return lockstep_program().tick(false);
}
LOCKSTEP_BTCPP_INLINE NodeStatus Tree::tickExactlyOnce() {
  return lockstep_program().tick(true);
}
LOCKSTEP_BTCPP_INLINE NodeStatus Tree::tickWhileRunning(std::chrono::milliseconds sleep_time) {
  return lockstep_program().tick_while_running([&] { lockstep_sleep(sleep_time); });
}
LOCKSTEP_BTCPP_INLINE void Tree::haltTree() {
  if (program_ != nullptr) program_->halt();
}
LOCKSTEP_BTCPP_INLINE bool Tree::lockstep_sleep(std::chrono::microseconds duration) {
  return wakeUpSignal()->waitFor(duration);
}
LOCKSTEP_BTCPP_INLINE void Tree::emitWakeUpSignal() {
  wakeUpSignal()->emitSignal();
}
LOCKSTEP_BTCPP_INLINE std::shared_ptr<WakeUpSignal> Tree::wakeUpSignal() const {
  return lockstep_program().wake_up();
}
LOCKSTEP_BTCPP_INLINE Blackboard::Ptr Tree::rootBlackboard() const {
  return subtrees.empty() ? nullptr : subtrees.front()->blackboard;
}
LOCKSTEP_BTCPP_INLINE TreeNode* Tree::rootNode() const {
  return program_ == nullptr ? nullptr : program_->root();
}
LOCKSTEP_BTCPP_INLINE void Tree::applyVisitor(
    const std::function<void(const TreeNode*)>& visitor) const {
  for (const auto& node : lockstep_program().nodes()) visitor(node.get());
}
LOCKSTEP_BTCPP_INLINE void Tree::applyVisitor(const std::function<void(TreeNode*)>& visitor) {
  for (const auto& node : lockstep_program().nodes()) visitor(node.get());
}

}  // namespace BT
