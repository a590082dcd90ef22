// Tells hooks and subscribers what happens to the nodes of a program's tree while it is ticked:
// their statuses as the library has them, each change when it happens. Included by program.h.
#pragma once

#include <lockstep/runtime.h>

#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/lockstep/program_nodes.h"
#include "behaviortree_cpp/lockstep/stand_in.h"

namespace BT::lockstep_detail {

class TreeWatch {
 public:
  TreeWatch(lockstep_run* run, const NodePlaces& places, const std::vector<TreeNode::Ptr>& nodes)
      : run_(run), nodes_(nodes), watched_(nodes.size()) {
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      const NodePlace& place = places.nodes[i];
      Watched& it = watched_[i];
      it.parent = place.parent;
      if (place.parent != i) watched_[place.parent].children.push_back(i);
      it.own = dynamic_cast<const StandsIn*>(nodes[i].get()) == nullptr;
      it.type = nodes[i]->type();
      it.begins = it.own ? Begins::Itself : begin_of(place.id, it.type);
      it.is_reactive = place.id == "ReactiveSequence" || place.id == "ReactiveFallback";
      it.keeps_results = place.id == "SequenceWithMemory";
      it.asks_again = place.id == "WhileDoElse";
      it.catches = place.id == "TryCatch";
    }
  }

  bool is_on() const { return is_on_; }
  void begin() {
    if (std::exchange(is_on_, true)) return;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const NodeStatus status = nodes_[i]->status();
      if (!watched_[i].own) node(i).lockstep_status_.store(status, std::memory_order_release);
      all.push_back(i);
    }
    if (lockstep_run_watch_nodes(run_, all.data(), all.size(), call, this)) return;
    is_on_ = false;
    throw RuntimeError(lockstep_last_error());
  }
  // After a halt of the tree: no node has a status any more.
  void forget_all() {
    if (is_on_) forget_below(0, true);
  }
  // After a tick: throws what a hook has thrown in it.
  void rethrow() {
    if (thrown_ != nullptr) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }
  bool has_thrown() const { return thrown_ != nullptr; }

 private:
  // When a node of the language is RUNNING.
  enum class Begins {
    Itself,     // it says so, or never is
    At_tick,    // in its first tick
    At_child,   // when its child is ticked
    At_result,  // when its tick has returned that
  };
  struct Watched {
    std::uint32_t parent = 0;
    std::vector<std::uint32_t> children;
    NodeType type = NodeType::UNDEFINED;
    Begins begins = Begins::Itself;
    bool own = false;            // an object of the program
    bool is_reactive = false;    // ticks all from the first child on
    bool keeps_results = false;  // of its children, when it fails
    bool asks_again = false;     // its first child, while another runs
    bool catches = false;        // a failure of one that is not the last
    bool is_decorator() const { return type == NodeType::DECORATOR || type == NodeType::SUBTREE; }
    std::chrono::steady_clock::time_point began;
  };

  static Begins begin_of(const std::string& id, NodeType type) {
    if (type == NodeType::ACTION || type == NodeType::CONDITION) return Begins::Itself;
    if (StartWith(id, "Switch") || id == "Precondition") return Begins::At_result;
    const bool may_skip = id == "RunOnce" || id == "SkipUnlessUpdated" || id == "WaitValueUpdate";
    return may_skip ? Begins::At_child : Begins::At_tick;
  }

  TreeNode& node(std::uint32_t index) { return *nodes_[index]; }
  void set(std::uint32_t index, NodeStatus status) { node(index).setStatus(status); }

  // For a node that does not run any more.
  void forget(std::uint32_t index) {
    const NodeStatus status = node(index).lockstep_status_.load(std::memory_order_relaxed);
    if (status == NodeStatus::IDLE || (watched_[index].own && !isStatusCompleted(status))) return;
    if (watched_[index].own) {
      node(index).lockstep_forget_status();
    } else {
      set(index, NodeStatus::IDLE);
    }
  }
  void forget_below(std::uint32_t index, bool with_it) {
    for (const std::uint32_t child : watched_[index].children) forget_below(child, true);
    if (with_it) forget(index);
  }
  void forget_children(std::uint32_t index) {
    for (const std::uint32_t child : watched_[index].children) forget(child);
  }

  lockstep_status before_tick(std::uint32_t index) {
    Watched& it = watched_[index];
    if (it.parent != index && watched_[it.parent].begins == Begins::At_child) {
      set(it.parent, NodeStatus::RUNNING);
    }
    if (it.own) return LOCKSTEP_IDLE;  // it calls its hooks itself
    TreeNode& node = this->node(index);
    const NodeStatus before = node.lockstep_status_.load(std::memory_order_relaxed);
    if (isStatusCompleted(before)) set(index, NodeStatus::IDLE);
    const auto* const hooks = node.lockstep_watch_.get();
    if (hooks != nullptr && hooks->before) {
      const NodeStatus decided = hooks->before(node);
      if (isStatusCompleted(decided)) return static_cast<lockstep_status>(decided);
    }
    if (hooks != nullptr && hooks->monitor) it.began = std::chrono::steady_clock::now();
    if (it.begins == Begins::At_tick) set(index, NodeStatus::RUNNING);
    return LOCKSTEP_IDLE;
  }

  lockstep_status after_tick(std::uint32_t index, NodeStatus status) {
    Watched& it = watched_[index];
    TreeNode& node = this->node(index);
    const auto* const hooks = node.lockstep_watch_.get();
    if (!it.own && hooks != nullptr) {
      if (hooks->monitor && it.began != std::chrono::steady_clock::time_point()) {
        const auto took =
            std::chrono::steady_clock::now() - std::exchange(it.began, decltype(it.began)());
        hooks->monitor(node, status, std::chrono::duration_cast<std::chrono::microseconds>(took));
      }
    }
    if (isStatusCompleted(status)) end_children(index, status);
    if (!it.own && hooks != nullptr && hooks->after) {
      const NodeStatus decided = hooks->after(node, status);
      if (isStatusCompleted(decided)) status = decided;
    }
    if (status != NodeStatus::SKIPPED) set(index, status);
    tell_parent(index, status);
    return static_cast<lockstep_status>(status);
  }

  // A node that completes resets its children before it has its result.
  void end_children(std::uint32_t index, NodeStatus status) {
    const Watched& it = watched_[index];
    if (!it.keeps_results || status == NodeStatus::SUCCESS) return forget_children(index);
    for (const std::uint32_t child : it.children) {
      const auto result = node(child).lockstep_status_.load(std::memory_order_relaxed);
      if (result != NodeStatus::SUCCESS) forget(child);
    }
  }

  // A parent changes its children at once.
  void tell_parent(std::uint32_t index, NodeStatus status) {
    const std::uint32_t above = watched_[index].parent;
    const Watched& parent = watched_[above];
    const bool is_complete = isStatusCompleted(status);
    const bool is_root = above == index;
    if (!is_root && parent.own) return;
    if (is_root || parent.is_decorator()) {
      if (is_complete) forget(index);
    } else if (parent.is_reactive && status == NodeStatus::RUNNING) {
      for (const std::uint32_t other : parent.children) {
        const auto it = node(other).lockstep_status_.load(std::memory_order_relaxed);
        if (other != index && isStatusCompleted(it)) forget(other);
      }
    } else if (parent.catches && status == NodeStatus::FAILURE && index != parent.children.back()) {
      forget_children(above);
    }
  }

  // A parent that halts a child has completed, or is halted: the children before it have no status
  // any more.
  void before_halt(std::uint32_t index) {
    const Watched& parent = watched_[watched_[index].parent];
    if (parent.own || parent.asks_again) return;
    for (const std::uint32_t other : parent.children) {
      if (other == index) return;
      const auto status = node(other).lockstep_status_.load(std::memory_order_relaxed);
      if (isStatusCompleted(status)) forget(other);
    }
  }

  static lockstep_status call(void* user, lockstep_run* /*run*/, std::uint32_t index,
                              std::int32_t what, lockstep_status status) {
    TreeWatch& self = *static_cast<TreeWatch*>(user);
    try {
      switch (what) {
        case LOCKSTEP_BEFORE_TICK:
          return self.before_tick(index);
        case LOCKSTEP_AFTER_TICK:
          return self.after_tick(index, static_cast<NodeStatus>(status));
        case LOCKSTEP_BEFORE_HALT:
          self.before_halt(index);
          break;
        case LOCKSTEP_AFTER_HALT:
          self.forget_below(index, true);
          break;
      }
    } catch (...) {  // what is thrown leaves the tick when it is over
      if (self.thrown_ == nullptr) self.thrown_ = std::current_exception();
      const bool is_tick = what == LOCKSTEP_BEFORE_TICK || what == LOCKSTEP_AFTER_TICK;
      if (is_tick) return LOCKSTEP_FAILURE;
    }
    return LOCKSTEP_IDLE;
  }

  lockstep_run* run_;
  const std::vector<TreeNode::Ptr>& nodes_;
  std::vector<Watched> watched_;
  bool is_on_ = false;
  std::exception_ptr thrown_;
};

}  // namespace BT::lockstep_detail
