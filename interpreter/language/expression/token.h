// The words of a script.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "language/expression/expression.h"

namespace lockstep::host {

enum class Symbol : std::uint8_t {
  End,
  Whole,
  Real,
  Text,
  Name,
  Word,     // running, behind status(arm) ==
  Reading,  // progress(arm): one token, as what is in the brackets is no expression
  Plus,
  Minus,
  Times,
  Divided,
  Join,
  BitAnd,
  BitOr,
  BitXor,
  Complement,
  And,
  Or,
  Not,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Make,
  Assign,
  AddTo,
  SubtractFrom,
  MultiplyBy,
  DivideBy,
  Question,
  Colon,
  Open,
  Close,
  Semicolon
};

struct Token {
  Symbol symbol;
  std::string_view text;   // of a Text, without the quotes; of a Reading, what is in the brackets
  std::size_t offset = 0;  // in the script
  std::int64_t whole = 0;
  double real = 0;
  Reading::What reading = {};
};

// Reads a script token by token.
class TokenReader {
 public:
  // The token at the beginning of script.substr(offset), after blanks; `offset` moves behind it.
  tl::expected<Token, Expression::Error> next(std::string_view script, std::size_t& offset);

 private:
  // What is compared with the next token, if it has words of its own: status(arm) == running.
  std::optional<Reading::What> read_, compared_;
};

}  // namespace lockstep::host
