// What leaves and this interface throw. One that leaves a node is a fault of the run.
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

// What only shows while it runs.
class RuntimeError : public BehaviorTreeException {
 public:
  using BehaviorTreeException::BehaviorTreeException;
};

}  // namespace BT
