// What is wrong with a command line: the word that nobody knows, what was probably meant, and where
// the help of that command is. CLI11 parses; it names the words that are left over, which may be
// others.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace lockstep {

struct UsageError {
  std::string message;
  std::string hint;
};

// A word in the place of a command that is none. `words` are without the program's name.
std::optional<UsageError> find_unknown_command(const CLI::App& program,
                                               std::span<const std::string> words);

// Why CLI11 refused them.
UsageError explain(const CLI::App& program, std::span<const std::string> words,
                   const CLI::ParseError& error);

}  // namespace lockstep
