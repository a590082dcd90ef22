// The types of nodes that a plugin has registered, as the host reads them.
#pragma once

#include <lockstep/ext/reason.h>
#include <lockstep/leaf.h>

#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/place.h"

namespace BT {
class TreeNode;
class SyncActionNode;
struct NodeConfig;
struct TreeNodeManifest;
using NodeBuilder = std::function<std::unique_ptr<TreeNode>(const std::string&, const NodeConfig&)>;
}  // namespace BT

namespace BT::lockstep_detail {

struct Leaf;
class Child;
class NodeThread;

// Facts and functions that a class of nodes may have for lockstep, beyond the library.
struct ClassHooks {
  bool is_at_once = false;  // it never returns RUNNING
  double (*progress)(const TreeNode&) = nullptr;
  void (*pause)(TreeNode&) = nullptr;
  void (*resume)(TreeNode&) = nullptr;
  double (*pace)(TreeNode&, double factor) = nullptr;
  std::string (*save)(const TreeNode&) = nullptr;  // these: both or none
  bool (*restore)(TreeNode&, const std::string& kept) = nullptr;
  void (*reason)(const TreeNode&, const lockstep_reason&, const lockstep_caller*) = nullptr;
};

template <class T, class = void>
inline constexpr bool has_progress = false;
template <class T>
inline constexpr bool has_progress<T, std::enable_if_t<std::is_convertible_v<
                                          decltype(std::declval<const T&>().progress()), double>>> =
    true;
template <class T, class = void>
inline constexpr bool has_on_paused = false;
template <class T>
inline constexpr bool has_on_paused<T, std::void_t<decltype(std::declval<T&>().onPaused())>> = true;
template <class T, class = void>
inline constexpr bool has_on_resumed = false;
template <class T>
inline constexpr bool has_on_resumed<T, std::void_t<decltype(std::declval<T&>().onResumed())>> =
    true;

template <class T, class = void>
inline constexpr bool has_on_pace = false;
template <class T>
inline constexpr bool has_on_pace<
    T, std::enable_if_t<std::is_convertible_v<decltype(std::declval<T&>().onPace(1.0)), double>>> =
    true;

template <class T, class = void>
inline constexpr bool has_on_save = false;
template <class T>
inline constexpr bool has_on_save<
    T, std::enable_if_t<
           std::is_convertible_v<decltype(std::declval<const T&>().onSave()), std::string>>> = true;
template <class T, class = void>
inline constexpr bool has_on_restored = false;
template <class T>
inline constexpr bool has_on_restored<
    T, std::enable_if_t<std::is_convertible_v<
           decltype(std::declval<T&>().onRestored(std::declval<const std::string&>())), bool>>> =
    true;

template <class T, class = void>
inline constexpr bool has_reason = false;
template <class T>
inline constexpr bool has_reason<
    T, std::enable_if_t<
           std::is_convertible_v<decltype(std::declval<const T&>().reason()), std::string>>> = true;

// A class of the library whose code is in these headers.
template <class T, class = void>
inline constexpr bool opens_by_class = false;
template <class T>
inline constexpr bool opens_by_class<T, std::void_t<typename T::LockstepOpens>> = true;

template <class Node, class From, class = void>
inline constexpr bool is_static_cast = false;
template <class Node, class From>
inline constexpr bool
    is_static_cast<Node, From, std::void_t<decltype(static_cast<Node&>(std::declval<From&>()))>> =
        true;

// A node as its class, which may derive virtually from the library's.
template <class Node, class From>
Node& as_class(From& node) {
  if constexpr (is_static_cast<Node, From>) {
    return static_cast<Node&>(node);
  } else {
    return dynamic_cast<Node&>(node);
  }
}

template <class T>
ClassHooks hooks_of() {
  ClassHooks hooks;
  if constexpr (opens_by_class<T>) note_opening<T>();
  hooks.is_at_once = std::is_base_of_v<SyncActionNode, T>;
  if constexpr (has_progress<T>) {
    hooks.progress = [](const TreeNode& node) -> double {
      return as_class<const T>(node).progress();
    };
  }
  if constexpr (has_on_paused<T>) {
    hooks.pause = [](TreeNode& node) { as_class<T>(node).onPaused(); };
  }
  if constexpr (has_on_resumed<T>) {
    hooks.resume = [](TreeNode& node) { as_class<T>(node).onResumed(); };
  }
  if constexpr (has_on_pace<T>) {
    hooks.pace = [](TreeNode& node, double factor) -> double {
      return as_class<T>(node).onPace(factor);
    };
  }
  static_assert(has_on_save<T> == has_on_restored<T>,
                "a node that goes on after a cut has std::string onSave() const and bool "
                "onRestored(const std::string&)");
  if constexpr (has_on_save<T>) {
    hooks.save = [](const TreeNode& node) -> std::string {
      return as_class<const T>(node).onSave();
    };
    hooks.restore = [](TreeNode& node, const std::string& kept) -> bool {
      return as_class<T>(node).onRestored(kept);
    };
  }
  if constexpr (has_reason<T>) {
    hooks.reason = [](const TreeNode& node, const lockstep_reason& table,
                      const lockstep_caller* caller) {
      const std::string& text = as_class<const T>(node).reason();  // which may be kept there
      table.say(caller, text.c_str());
    };
  }
  return hooks;
}

struct PortEntry {
  std::string name;
  PortInfo info;
  std::uint32_t index;  // for the host
};

// A node's path in the library's words, and what the document gives it.
struct NodeNumber {
  std::string path;
  std::uint16_t uid = 0;
  bool is_read = false;  // the rest is there
  std::string id = {};
  const TreeNodeManifest* manifest = nullptr;
  std::unordered_map<std::string, std::string> input_ports = {}, output_ports = {},
                                               other_attributes = {};
};

// One type of node.
struct Registration {
  const TreeNodeManifest* manifest;  // the table's
  NodeBuilder build;
  std::vector<PortEntry> ports;  // by name
  std::list<lockstep_port> described = {};
  std::vector<const lockstep_port*> listed = {};
  std::list<std::string> texts = {};  // that the descriptors point to
  lockstep_leaf_type type = {};
};

}  // namespace BT::lockstep_detail
