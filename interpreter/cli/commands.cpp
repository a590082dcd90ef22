#include <fmt/format.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/help_text.h"
#include "cli/run/groot.h"
#include "cli/usage.h"
#include "engine/call_mark.h"
#include "runtime/fuse.h"
#include "runtime/outlet.h"
#include "system/descriptors.h"
#include "system/own_thread.h"
#include "terminal/raw_terminal.h"
#include "terminal/terminal.h"
#include "web/server_socket.h"

namespace lockstep::host {

extern const Command kRunCommand, kCheckCommand, kShowCommand, kNodesCommand, kSchemaCommand,
    kConvertCommand, kPluginCommand, kLogCommand, kReplayCommand, kStudyCommand, kMonitorCommand,
    kVerifyCommand, kTestCommand, kNewCommand, kFmtCommand, kLspCommand;

std::span<const Command* const> commands() {
  static constexpr const Command* kAll[] = {
      &kNewCommand,    &kRunCommand,     &kCheckCommand,   &kVerifyCommand,
      &kTestCommand,   &kShowCommand,    &kNodesCommand,   &kSchemaCommand,
      &kFmtCommand,    &kConvertCommand, &kPluginCommand,  &kLogCommand,
      &kReplayCommand, &kStudyCommand,   &kMonitorCommand, &kLspCommand};
  return kAll;
}

namespace {

constexpr const char* kHelp = "help";

// `lockstep help log info` is `lockstep log info --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != kHelp) return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

// The value of these options may be left out, and what follows may be a file: gives them their
// values.
std::vector<std::string> complete_addresses(const std::vector<std::string>& words) {
  const std::map<std::string_view, std::string_view> defaults{{"--monitor", kAnyLoopback},
                                                              {"--groot2", kGrootAddress}};
  std::vector<std::string> complete;
  for (std::size_t i = 0; i < words.size(); ++i) {
    complete.push_back(words[i]);
    const auto option = defaults.find(words[i]);
    if (option == defaults.end()) continue;
    const bool has_value = i + 1 < words.size() && looks_like_address(words[i + 1]);
    complete.back() += '=' + (has_value ? words[++i] : std::string(option->second));
  }
  return complete;
}

constexpr const char* kHowToGetAll = "./dev build, or cmake -DLOCKSTEP_TOOLS=ON and build again";

std::function<int()> define_absent(CLI::App& app) {
  app.allow_extras();
  return [name = app.get_name()] {
    print_error(fmt::format("this lockstep was built without '{}'", name), kHowToGetAll);
    return kExitUsage;
  };
}

int refuse(const UsageError& error) {
  print_error(error.message, error.hint);
  return kExitUsage;
}

void parse(CLI::App& app, std::vector<std::string> words) {
  std::ranges::reverse(words);  // as CLI11 takes them
  app.parse(std::move(words));
}

// The commands as CLI11 knows them. Their options take longer to define than many a command takes,
// so those of commands that are not named can be left out, but a hint may be about any of them.
class Program {
 public:
  enum class Options { OfNamedCommands, OfAllCommands };

  Program(const std::vector<std::string>& words, Options options);

  CLI::App& app() { return app_; }
  // Runs the command that was parsed.
  int run() const;

 private:
  CLI::App app_{"lockstep: behavior trees that move several things at once and keep them in step",
                "lockstep"};
  std::vector<std::pair<const CLI::App*, std::function<int()>>> actions_;
};

Program::Program(const std::vector<std::string>& words, Options options) {
  app_.formatter(help_formatter(terminal_size(STDOUT_FILENO).width));
  app_.require_subcommand(1);
  app_.set_version_flag("--version", "lockstep " LOCKSTEP_VERSION);
  app_.footer(
      "Exit code: 0 all is well, 1 the run failed or what was compared differs, 2 usage or a file "
      "that cannot be used, 3 invalid tree, 4 plugin refused, 5 leaf fault, 6 a plugin crashed or "
      "hung, 9 lockstep failed, 124 a limit was reached, 128 + N signal N. The help of a command "
      "has those that it uses.\n\n"
      "Example: lockstep run trees/door_pulling.xml\n\n"
      "`lockstep help COMMAND` shows the options of a command and examples.");
  for (const Command* command : commands()) {
    CLI::App* subcommand = app_.add_subcommand(command->name, command->summary);
    const bool is_named = std::ranges::find(words, command->name) != words.end();
    if (options == Options::OfNamedCommands && !is_named) continue;
    subcommand->footer(command->examples);
    actions_.emplace_back(subcommand, command->define(*subcommand));
  }
  app_.add_subcommand(kHelp, "Show the help of a command: lockstep help log info");
}

int Program::run() const {
  for (const auto& [command, action] : actions_) {
    if (command->parsed()) return action();
  }
  return kExitUsage;
}

// Nothing after a mistake, if the options of some commands are left out.
std::optional<int> run_words(const std::vector<std::string>& words, Program::Options options) {
  const bool may_explain = options == Program::Options::OfAllCommands;
  Program program(words, options);
  if (const auto error = find_unknown_command(program.app(), words)) {
    return may_explain ? std::optional(refuse(*error)) : std::nullopt;
  }
  try {
    parse(program.app(), words);
  } catch (const CLI::Success& success) {  // --help, --version
    std::ostringstream text;
    program.app().exit(success, text);
    return write_results(text.str());
  } catch (const CLI::ParseError& error) {
    if (!may_explain) return std::nullopt;
    return refuse(explain(program.app(), words, error));
  }
  return program.run();
}

int run_command_line(int argc, char** argv) {
  const auto words = complete_addresses(words_of(argc, argv));
  if (const auto code = run_words(words, Program::Options::OfNamedCommands)) return *code;
  return run_words(words, Program::Options::OfAllCommands).value_or(kExitUsage);
}

void say_out_of_memory() {
  messages().say("lockstep: error: out of memory\n");  // which takes none
}

bool is_in_plugin() {
  return !is_own_thread() || CallMark::this_thread().look().function != PluginFunction::None;
}

// A destructor that takes memory, as that of a JSON value does, ends here when there is none. What
// nobody catches in a plugin is its crash.
[[noreturn]] void on_terminate() {
  try {
    if (const auto reason = std::current_exception(); reason != nullptr && !is_in_plugin()) {
      std::rethrow_exception(reason);
    }
  } catch (const std::bad_alloc&) {
    RawTerminal::restore_for_good();
    say_out_of_memory();
    messages().flush(Outlet::kPatience);
    end_at_once(kExitInternal);
  } catch (...) {  // the report of the crash says no less
  }
  std::abort();
}

}  // namespace

Command absent(const char* name) {
  return {name, "Not in this build", kHowToGetAll, define_absent};
}

int run_program(int argc, char** argv) {
  std::set_terminate(on_terminate);
  make_writes_fail();
  try {
    try {
      return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      print_error(error.what(), "this is a bug in lockstep; please report it");
    }
  } catch (const std::bad_alloc&) {
    say_out_of_memory();
  }
  return kExitInternal;
}

}  // namespace lockstep::host
