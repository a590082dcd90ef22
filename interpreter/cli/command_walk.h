// How far a command line can be followed: the command that it names, and what it has of it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lockstep::host {

struct CommandWalk {
  const CLI::App* command;             // the innermost that the line names
  std::string unknown_option;          // the first
  const CLI::App* unknown_at;          // the command that it was given to
  std::string empty_option;            // the first that lacks its value
  const CLI::Option* open = nullptr;   // an option at the end of the line that lacks its value
  std::vector<std::string> arguments;  // of that command, that are neither options nor their values
};

CommandWalk follow(const CLI::App& program, std::span<const std::string> words);

std::vector<const CLI::App*> subcommands(const CLI::App& command);
// Null when there is none.
const CLI::Option* find_option(const CLI::App& command, const std::string& name);
bool takes_value(const CLI::Option& option);
// "lockstep log info"
std::string command_line_of(const CLI::App& command);
// "log info" of "lockstep log info"
std::string command_name_of(const CLI::App& command);

}  // namespace lockstep::host
