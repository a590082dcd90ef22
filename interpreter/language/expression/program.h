// The compiled form of an expression: flat, for a machine with a stack of operands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::host {

enum class Operation : std::uint8_t {
  // Push a constant, or the value of an entry.
  Real,
  Whole,
  Truth,  // the real number of true or false
  Text,
  Load,
  LoadCopy,       // a text is copied: the entry may be assigned before it is used
  LoadShown,      // the text of its value, as for people; without a value {key}
  LoadToCompare,  // a number and Compare follow: it has that number and the relation, too
  // Replace two operands by their result.
  Add,
  Subtract,
  Multiply,
  Divide,
  Join,
  BitAnd,
  BitOr,
  BitXor,
  And,
  Or,
  Compare,
  CompareNext,  // leaves the right operand; or, if it does not hold, 0, and goes to `argument`
  // Replace one.
  Negate,
  Complement,
  Not,
  // Assignments: before the right side is evaluated, and after it.
  Make,  // the entry `argument`, if it does not exist
  Need,  // an error if it does not exist
  Store,
  AddTo,
  SubtractFrom,
  MultiplyBy,
  DivideBy,
  NoTarget,  // an error: the left side is not a name
  JumpIfZero,
  Jump,
  Pop,
  End
};

enum class Relation : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual };

// Instruction::whole of a comparison: with the progress of a node.
inline constexpr std::int64_t kOfProgress = 1;

struct Instruction {
  Operation operation;
  Relation relation = {};
  std::uint32_t argument = 0;  // a text, a name, or the instruction to go to
  union {
    std::int64_t whole = 0;
    double real;
  };

  static Instruction of(Operation operation, std::uint32_t argument = 0) {
    return {operation, {}, argument, {}};
  }
  static Instruction of(Operation operation, double real) {
    Instruction it = of(operation);
    it.real = real;
    return it;
  }
  static Instruction of(std::int64_t whole) { return {Operation::Whole, {}, 0, {whole}}; }
};

struct ScriptProgram {
  std::vector<Instruction> code;
  std::uint32_t stack = 0;  // how many operands there are at most
  std::vector<std::string> texts;
};

}  // namespace lockstep::host
