// A value, or why there is none: what a leaf type that cannot be described says.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace ros2 {

struct Problem {
  std::string message;
  std::string hint = {};
};

template <class T>
class Result {
 public:
  Result(T value) : it_(std::move(value)) {}
  Result(Problem problem) : it_(std::move(problem)) {}
  explicit operator bool() const { return std::holds_alternative<T>(it_); }
  T& operator*() { return std::get<T>(it_); }
  T* operator->() { return &std::get<T>(it_); }
  const Problem& problem() const { return std::get<Problem>(it_); }

 private:
  std::variant<T, Problem> it_;
};

}  // namespace ros2
