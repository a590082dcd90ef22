// A compiled script: an expression over the entries of a blackboard, or several in a row, which may
// assign. docs/language.md has the grammar.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace lockstep {

class Expression {
 public:
  struct Error {
    std::string message;
    std::string hint;
    std::size_t offset;  // bytes into the text
  };
  static tl::expected<Expression, Error> parse(std::string_view text);

  // The entries that it reads or assigns, each once, as they are written; "@k" with its '@'.
  std::span<const std::string> names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

}  // namespace lockstep
