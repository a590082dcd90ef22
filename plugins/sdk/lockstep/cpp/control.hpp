// Control and Decorator, from which control nodes and decorators derive. Included by
// lockstep/leaf.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "action.hpp"

namespace lockstep {
inline namespace sdk1 {

namespace detail {

// The children of one node, by index from 0.
class Children {
 public:
  explicit Children(const Caller& caller) : caller_(caller.id), table_(find(*caller.host)) {}

  std::uint32_t count() const { return table_.count(caller_); }
  Status tick(std::uint32_t child) const {
    return static_cast<Status>(table_.tick(caller_, child));
  }
  Status tick_unreset(std::uint32_t child) const {
    return static_cast<Status>(table_.tick_unreset(caller_, child));
  }
  void halt(std::uint32_t child) const { table_.halt(caller_, child); }
  void pause(std::uint32_t child) const { table_.pause(caller_, child); }
  std::optional<Status> status(std::uint32_t child) const {
    const lockstep_status status = table_.status(caller_, child);
    if (status == LOCKSTEP_IDLE) return std::nullopt;
    return static_cast<Status>(status);
  }
  double progress(std::uint32_t child) const { return table_.progress(caller_, child); }

 private:
  static const lockstep_children& find(const lockstep_host& host) {
    const void* const table = host.get_extension(LOCKSTEP_CHILDREN);
    if (table == nullptr) throw std::runtime_error("this host does not know control nodes");
    return *static_cast<const lockstep_children*>(table);
  }

  const lockstep_caller* caller_;
  const lockstep_children& table_;
};

}  // namespace detail

// Common to control nodes and decorators: an action with children. Without an override of
// progress(), the node has the least progress of its children that run. What the children do is in
// the hands of tick(); lockstep halts those that still run when the node completes, and halts and
// pauses them all before the node's own halt() and pause(). docs/plugins.md has the rules.
class ControlFunctions : public ActionFunctions {
 public:
  // Redeclare both in a control node that needs another number of children; at most 0: any number.
  static constexpr std::uint32_t kMinChildren = 1, kMaxChildren = 0;

 protected:
  ControlFunctions() : children_(this->caller_) {}
  const detail::Children children_;
};

// Children are counted from 0. tick_child, tick_child_unreset, halt_child and pause_child belong
// into tick(); each child is ticked at most once in a tick, except in trees for BehaviorTree.CPP.
template <class PortsOfNode = NoPorts>
class Control : public ControlFunctions, public PortsOfNode {
 public:
  using PortsType = PortsOfNode;

 protected:
  Control() { detail::PortsAccess::bind(*this, this->caller_); }

  std::uint32_t child_count() const { return children_.count(); }
  Status tick_child(std::uint32_t child) { return children_.tick(child); }
  // The same, but an action that has completed in this activation of the node is not begun again:
  // it gives its result once more. docs/plugins.md has what other children do.
  Status tick_child_unreset(std::uint32_t child) { return children_.tick_unreset(child); }
  // Ends the child's activation, if it runs.
  void halt_child(std::uint32_t child) { children_.halt(child); }
  // Holds the child, if it runs, until it is ticked again.
  void pause_child(std::uint32_t child) { children_.pause(child); }
  // The result of its last tick; nothing before its first one, and after a halt.
  std::optional<Status> child_status(std::uint32_t child) const { return children_.status(child); }
  // In [0, 1]: 1 after Success, 0 after Failure.
  double child_progress(std::uint32_t child) const { return children_.progress(child); }
};

// The same with one child.
template <class PortsOfNode = NoPorts>
class Decorator : public ControlFunctions, public PortsOfNode {
 public:
  using PortsType = PortsOfNode;

 protected:
  Decorator() { detail::PortsAccess::bind(*this, this->caller_); }

  Status tick_child() { return children_.tick(0); }
  void halt_child() { children_.halt(0); }
  void pause_child() { children_.pause(0); }
  std::optional<Status> child_status() const { return children_.status(0); }
  double child_progress() const { return children_.progress(0); }
};

namespace detail {

template <class PortsOfNode>
std::true_type derives_from_decorator(const Decorator<PortsOfNode>*);
std::false_type derives_from_decorator(const void*);

template <class T>
constexpr lockstep_leaf_kind kind_of() {
  if (!std::is_base_of_v<ActionFunctions, T>) return LOCKSTEP_CONDITION;
  if (!std::is_base_of_v<ControlFunctions, T>) return LOCKSTEP_ACTION;
  return decltype(derives_from_decorator(static_cast<const T*>(nullptr)))::value
             ? LOCKSTEP_DECORATOR
             : LOCKSTEP_CONTROL;
}

}  // namespace detail

}  // namespace sdk1
}  // namespace lockstep
