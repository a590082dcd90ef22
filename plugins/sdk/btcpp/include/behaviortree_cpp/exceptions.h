// Leaves and this interface throw these. One that leaves a node is a fault of the run.
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "behaviortree_cpp/utils/strcat.hpp"

namespace BT {

class BehaviorTreeException : public std::exception {
 public:
  template <class... Texts>
  explicit BehaviorTreeException(const Texts&... texts) : message_(StrCat(texts...)) {}

  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

// A mistake in the program.
class LogicError : public BehaviorTreeException {
 public:
  using BehaviorTreeException::BehaviorTreeException;
};

// A mistake that shows only while a tree runs.
class RuntimeError : public BehaviorTreeException {
 public:
  using BehaviorTreeException::BehaviorTreeException;
};

// The node that has thrown.
struct TickBacktraceEntry {
  std::string node_name;
  std::string node_path;
  std::string registration_name;
};

// A tick of a program's tree throws this when a node has thrown, or does what no node may.
class NodeExecutionError : public RuntimeError {
 public:
  NodeExecutionError(TickBacktraceEntry node, const std::string& message)
      : RuntimeError("Exception in node '", node.node_path, "' [", node.registration_name,
                     "]: ", message),
        node_(std::move(node)),
        message_(message) {}

  [[nodiscard]] const TickBacktraceEntry& failedNode() const { return node_; }
  [[nodiscard]] const std::string& originalMessage() const { return message_; }

 private:
  TickBacktraceEntry node_;
  std::string message_;
};

}  // namespace BT
