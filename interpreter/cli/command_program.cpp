#include "cli/command_program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/core/version.h"
#include "base/terminal/terminal.h"
#include "cli/about.h"
#include "cli/command.h"
#include "cli/exit_code.h"
#include "cli/help_text.h"

namespace lockstep::host {

Program::Program(const std::vector<std::string>& words, Options options)
    : app_(std::make_unique<CLI::App>(
          "lockstep: behavior trees that move several things at once and keep them in step",
          "lockstep")) {
  app_->formatter(help_formatter(terminal_size(STDOUT_FILENO).width));
  app_->require_subcommand(1);
  CLI::Option* const verbose = app_->add_flag(
      "--verbose", is_verbose_, "With --version: also the parts, the paths and the other versions");
  CLI::Option* const version = app_->set_version_flag(
      "--version",
      [this] { return is_verbose_ ? about_text() : std::string("lockstep ") + kVersion; },
      "Print the version and exit");
  verbose->needs(version);
  app_->footer(
      "Exit code: 0 success, 1 the run failed or a comparison found a difference, 2 wrong usage, 3 "
      "a tree is invalid or cannot be read, 4 plugin refused, 5 leaf fault, 6 a plugin crashed or "
      "hung, 9 lockstep failed, 124 a limit was reached, 128 + N signal N. The help of a command "
      "lists its codes.\n"
      "\n"
      "Example: lockstep run --example door_pulling\n"
      "\n"
      "`lockstep help COMMAND` shows the options of a command and examples. `lockstep docs "
      "tutorial` is the tutorial, `lockstep docs glossary` defines the terms.");
  const bool leaves_out = options == Options::OfNamedCommands;
  const bool begins_with_command =
      !words.empty() && std::ranges::find(commands(), words[0], &Command::name) != commands().end();
  for (const Command* command : commands()) {
    const bool is_named = std::ranges::find(words, command->name) != words.end();
    if (leaves_out && !is_named && begins_with_command) continue;
    CLI::App* subcommand = app_->add_subcommand(command->name, command->summary);
    if (leaves_out && !is_named) continue;
    subcommand->footer(command->examples);
    actions_.emplace_back(subcommand, command->define(*subcommand));
  }
  app_->add_subcommand("help", "Show the help of a command: lockstep help log info");
}

Program::~Program() = default;

int Program::run() const {
  for (const auto& [command, action] : actions_) {
    if (command->parsed()) return action();
  }
  return kExitUsage;
}

}  // namespace lockstep::host
