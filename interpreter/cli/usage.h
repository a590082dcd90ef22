// The error in a command line: the unknown word, a suggestion, and the help of that command. CLI11
// parses, but it names the words that are left over, which may be different ones.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace lockstep::host {

struct UsageError {
  std::string message;
  std::string hint;
};

// An unknown word in the place of a command. `words` are without the program's name.
std::optional<UsageError> find_unknown_command(const CLI::App& program,
                                               std::span<const std::string> words);

// An option without a value: as "--record=", for which CLI11 would take the next word, or with an
// empty one, as a script has it whose variable is not set: no command may take that for the option
// that is absent.
std::optional<UsageError> find_empty_option(const CLI::App& program,
                                            std::span<const std::string> words);

// Why CLI11 refused them.
UsageError explain(const CLI::App& program, std::span<const std::string> words,
                   const CLI::ParseError& error);

}  // namespace lockstep::host
