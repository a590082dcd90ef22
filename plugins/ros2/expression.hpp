// Expressions over the fields of messages: the progress of an action,
// 1 - feedback.distance / first(feedback.distance), and conditions, message.percentage < 0.2.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "result.hpp"

namespace ros2 {

class Expression {
 public:
  // A step of the calculation, which takes its operands from a stack.
  struct Step {
    enum class What {
      Number,
      Field,
      Size,
      Given,  // Inputs::given
      First,
      Negate,
      Add,
      Subtract,
      Multiply,
      Divide,
      Least,
      Most,
      Less,
      LessOrEqual,
      Equal,
      Not,
      And,
      Or
    };
    What what;
    double number = 0;          // of a Number
    std::size_t index = 0;      // of a Field or a Size: its place in the list; of a First: which
    bool is_of_second = false;  // message, of a Field or a Size
  };

  // An activation remembers this.
  using Memory = std::vector<std::optional<double>>;
  struct Source {
    const std::vector<Field>* fields = nullptr;
    const void* message = nullptr;
  };
  struct Inputs {
    Source first, second;
    double given = 0;  // what the text calls `elapsed` or `factor`
  };

  Memory memory() const { return Memory(firsts_); }
  // What is true is 1, what is not 0. Nothing: it is not known now, as after a division by 0.
  std::optional<double> value(const Inputs& inputs, Memory& memory) const;
  bool is_empty() const { return steps_.empty(); }
  // Of the second source.
  bool uses_second() const;

 private:
  friend class ExpressionReader;
  std::vector<Step> steps_;
  std::size_t firsts_ = 0;
};

// The problem is about the text.
Result<Expression> read_progress(const std::string& text, const std::vector<Field>& goal,
                                 const std::vector<Field>& feedback);
// `prefix` is that of the fields: "message.".
Result<Expression> read_condition(const std::string& text, const std::string& prefix,
                                  const std::vector<Field>& fields);

// Over `factor`. How fast a robot is to be, as the number that it is told.
Result<Expression> read_factor(const std::string& text);

}  // namespace ros2
