#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <sstream>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "core/descriptors.h"
#include "core/suggest.h"
#include "runtime/outlet.h"

namespace lockstep {

std::span<const Command* const> commands() {
  static constexpr const Command* kAll[] = {&kRunCommand,    &kCheckCommand,  &kShowCommand,
                                            &kNodesCommand,  &kSchemaCommand, &kLogCommand,
                                            &kReplayCommand, &kStudyCommand};
  return kAll;
}

namespace {

// CLI11 would only say that a subcommand is required.
bool is_unknown(std::string_view command) {
  std::vector<std::string_view> names;
  for (const Command* it : commands()) names.emplace_back(it->name);
  if (command.starts_with('-') || std::ranges::find(names, command) != names.end()) return false;
  const std::string near = did_you_mean(command, names);
  print_error(fmt::format("unknown command '{}'", printable(command)),
              near.empty() ? fmt::format("commands: {}", fmt::join(names, ", ")) : near);
  return true;
}

int run_command_line(int argc, char** argv) {
  if (argc > 1 && is_unknown(argv[1])) return kExitUsage;
  CLI::App app{"lockstep: behavior trees that move several things at once and keep them in step",
               "lockstep"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "lockstep " LOCKSTEP_VERSION);
  app.footer(
      "Example: lockstep run trees/door_pulling.xml\n"
      "`lockstep COMMAND --help` shows the options of a command and examples.");
  std::vector<std::function<int()>> actions;
  std::vector<CLI::App*> subcommands;
  for (const Command* command : commands()) {
    CLI::App* subcommand = app.add_subcommand(command->name, command->summary);
    subcommand->footer(command->examples);
    actions.push_back(command->define(*subcommand));
    subcommands.push_back(subcommand);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    std::ostringstream text;
    app.exit(success, text);
    return write_results(text.str());
  } catch (const CLI::ParseError& error) {
    print_error(error.what(), "see `lockstep --help`");
    return kExitUsage;
  }
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!subcommands[i]->parsed()) continue;
    return actions[i]();
  }
  return kExitUsage;
}

}  // namespace

int run_program(int argc, char** argv) {
  make_writes_fail();
  try {
    try {
      return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      print_error(error.what(), "this is a bug of lockstep; please report it");
    }
  } catch (const std::bad_alloc&) {
    messages().say("lockstep: error: out of memory\n");  // which takes none
  }
  return kExitInternal;
}

}  // namespace lockstep
