// The commands of the program: each is a row in a separate file, and commands.cpp lists them.
#pragma once

#include <functional>
#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace lockstep::host {

struct Command {
  const char* name;
  const char* summary;
  const char* examples;  // lines for the end of --help
  // Adds the command's options to `app`; the function it returns runs the command and gives the
  // exit code.
  std::function<int()> (*define)(CLI::App& app);
};

// One that this build leaves out: it says so, whatever its arguments are.
Command absent(const char* name);

// All commands, in the order of --help.
std::span<const Command* const> commands();

// Parses the command line and runs the command. Returns the exit code.
int run_program(int argc, char** argv);

}  // namespace lockstep::host
