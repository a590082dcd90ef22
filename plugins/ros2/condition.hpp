// The port `condition` of RosReceive and RosService: whether a message is what is waited for.
#pragma once

#include <lockstep/leaf.h>

#include <string>
#include <vector>

#include "elements.hpp"
#include "expression.hpp"

namespace ros2 {

constexpr lockstep_port condition_port(const char* doc) {
  return input("condition", LOCKSTEP_STRING, nullptr, doc, LOCKSTEP_FIXED | LOCKSTEP_OPTIONAL);
}

class Condition {
 public:
  // Of an element. False, and the problem in `refusal`: its text is none.
  bool read(const FixedTexts& texts, const lockstep_port& port, const std::string& prefix,
            const std::vector<Field>& fields, Refusal& refusal);
  // Without a text, always.
  bool holds(const void* message, double elapsed, Expression::Memory& memory) const;
  const std::string& text() const { return text_; }
  bool is_given() const { return !expression_.is_empty(); }
  Expression::Memory memory() const { return expression_.memory(); }

 private:
  std::string text_;
  const std::vector<Field>* fields_ = nullptr;
  Expression expression_;
};

}  // namespace ros2
