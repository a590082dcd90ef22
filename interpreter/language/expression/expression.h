// A compiled script: an expression over the entries of a blackboard, or several in a row, which may
// assign. docs/expressions.md has the grammar. language/expression/evaluator.h runs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "language/expression/program.h"
#include "language/expression/reading.h"
#include "language/expression/script_enums.h"

namespace lockstep::host {

class Expression {
 public:
  struct Error {
    std::string message;
    std::string hint;
    std::size_t offset;  // bytes into the text
  };
  // How a script uses an entry.
  struct Use {
    bool is_read = false;
    bool is_assigned = false;
    bool is_made = false;    // by ':=', if it does not exist
    std::size_t offset = 0;  // of its name, at the first place
  };
  // Whether 'and' is '&&' and 'or' is '||', which must be escaped in XML.
  enum class Words : bool { AreNames, AreSigns };
  // Texts that are compared with numbers may be words of `enums`, too; null: there are none.
  static tl::expected<Expression, Error> parse(std::string_view text,
                                               std::shared_ptr<const ScriptEnums> enums = nullptr,
                                               Words words = Words::AreNames);

  // A text in which {key} stands for the value of an entry: what it is then is its value.
  static tl::expected<Expression, Error> parse_template(std::string_view text);

  // The entries that it reads or assigns, each once, as they are written; "@k" with its '@'.
  std::span<const std::string> names() const { return names_; }
  // The uses of each of them.
  std::span<const Use> uses() const { return uses_; }
  // What it reads of the run, each once. In the program they are numbered behind the names.
  std::span<const Reading> readings() const { return readings_; }
  // The places that fail when they are reached: assignments to something that is not a name.
  std::span<const Error> remarks() const { return remarks_; }

  // As it was parsed.
  const std::string& text() const { return text_; }
  const ScriptProgram& program() const { return program_; }
  // The instruction of an expression that only compares a name, its first, with a number. Most
  // conditions do no more.
  const Instruction* comparison() const {
    const std::vector<Instruction>& code = program_.code;
    const bool is_one = code.size() == 4 && code[0].operation == Operation::LoadToCompare;
    return is_one ? code.data() : nullptr;
  }
  // Where in the text each instruction comes from.
  std::span<const std::uint32_t> offsets() const { return offsets_; }
  const ScriptEnums* enums() const { return enums_.get(); }

 private:
  friend class ExpressionParser;

  std::string text_;
  ScriptProgram program_;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::string> names_;
  std::vector<Use> uses_;
  std::vector<Reading> readings_;
  std::vector<Error> remarks_;
  std::shared_ptr<const ScriptEnums> enums_;
};

}  // namespace lockstep::host
