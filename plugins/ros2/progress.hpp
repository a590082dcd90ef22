// The progress of an action as an expression over its goal and its feedback:
// 1 - feedback.distance / first(feedback.distance)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "result.hpp"

namespace ros2 {

class Progress {
 public:
  // A step of the calculation, which takes its operands from a stack.
  struct Step {
    enum class What {
      Number,
      Field,
      Size,
      Elapsed,
      First,
      Negate,
      Add,
      Subtract,
      Multiply,
      Divide,
      Least,
      Most
    };
    What what;
    double number = 0;        // of a Number
    std::size_t index = 0;    // of a Field or a Size: its place in the list; of a First: which
    bool is_of_goal = false;  // of a Field or a Size
  };

  // An activation remembers this.
  using Memory = std::vector<std::optional<double>>;
  struct Inputs {
    const std::vector<Field>* goal_fields;
    const void* goal;
    const std::vector<Field>* feedback_fields;
    const void* feedback;
    double elapsed;
  };

  Memory memory() const { return Memory(firsts_); }
  // In [0, 1]. Nothing: it is not known now, as after a division by 0.
  std::optional<double> value(const Inputs& inputs, Memory& memory) const;
  bool is_empty() const { return steps_.empty(); }
  bool uses_feedback() const;

 private:
  friend class ProgressReader;
  std::vector<Step> steps_;
  std::size_t firsts_ = 0;
};

// The problem is about the text.
Result<Progress> read_progress(const std::string& text, const std::vector<Field>& goal,
                               const std::vector<Field>& feedback);

}  // namespace ros2
