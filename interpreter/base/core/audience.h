// Whom messages are for: a person at a command line, who has given options, or a program that
// embeds lockstep, which has called functions. Each calls the same by another name.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// As long as it lives, what this thread does is for a program.
class ForProgram {
 public:
  ForProgram();
  ~ForProgram();
  ForProgram(const ForProgram&) = delete;
  ForProgram& operator=(const ForProgram&) = delete;

 private:
  bool before_;
};

bool is_for_program();

// The words for whom it is.
template <class Text>
Text worded(Text for_command_line, Text for_program) {
  return is_for_program() ? for_program : for_command_line;
}

// How an entry of the main tree gets a value before a run: "give it a value with --set speed=…".
std::string how_to_give(std::string_view entry);

}  // namespace lockstep::host
