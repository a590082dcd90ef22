#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "base/system/call_mark.h"
#include "base/system/descriptors.h"
#include "base/system/own_thread.h"
#include "base/terminal/outlet.h"
#include "base/terminal/raw_terminal.h"
#include "cli/command.h"
#include "cli/command_program.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/run/groot.h"
#include "cli/usage.h"
#include "run/fuse.h"
#include "show/web/server_socket.h"

namespace lockstep::host {

extern const Command kRunCommand, kCheckCommand, kShowCommand, kDiffCommand, kNodesCommand,
    kSchemaCommand, kConvertCommand, kPluginCommand, kLogCommand, kReplayCommand, kStudyCommand,
    kMonitorCommand, kCheckpointCommand, kAnswerCommand, kAttendCommand, kVerifyCommand,
    kTestCommand, kNewCommand, kFmtCommand, kLspCommand, kCompletionCommand, kManualCommand,
    kDoctorCommand, kDocsCommand, kExamplesCommand, kMcpCommand, kTeamCommand;

std::span<const Command* const> commands() {
  static constexpr const Command* kAll[] = {
      &kNewCommand,        &kRunCommand,     &kCheckCommand,  &kVerifyCommand, &kTestCommand,
      &kShowCommand,       &kDiffCommand,    &kNodesCommand,  &kSchemaCommand, &kFmtCommand,
      &kConvertCommand,    &kPluginCommand,  &kLogCommand,    &kReplayCommand, &kStudyCommand,
      &kTeamCommand,       &kMonitorCommand, &kAnswerCommand, &kAttendCommand, &kCheckpointCommand,
      &kLspCommand,        &kMcpCommand,     &kDoctorCommand, &kDocsCommand,   &kExamplesCommand,
      &kCompletionCommand, &kManualCommand};
  return kAll;
}

namespace {

// `lockstep help log info` is `lockstep log info --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
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

// Nothing after a mistake, if the options of some commands are left out.
std::optional<int> run_words(const std::vector<std::string>& words, Program::Options options) {
  const bool may_explain = options == Program::Options::OfAllCommands;
  Program program(words, options);
  if (const auto error = find_unknown_command(program.app(), words)) {
    return may_explain ? std::optional(refuse(*error)) : std::nullopt;
  }
  if (const auto error = find_empty_option(program.app(), words)) return refuse(*error);
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

std::atomic<bool> has_lacked_memory{false};

void on_new_failed() {
  has_lacked_memory = true;
  throw std::bad_alloc();
}

// Out of a function that is noexcept, as some of simdjson are, the compiler may end the program
// before the exception is the current one.
bool is_out_of_memory() {
  const auto reason = std::current_exception();
  if (reason == nullptr) return has_lacked_memory && std::uncaught_exceptions() > 0;
  try {
    std::rethrow_exception(reason);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {  // the report of the crash says no less
    return false;
  }
}

// A destructor that takes memory, as that of a JSON value does, ends here when there is none. An
// exception that a plugin does not catch is a crash of that plugin.
[[noreturn]] void on_terminate() {
  if (is_in_plugin() || !is_out_of_memory()) std::abort();
  RawTerminal::restore_for_good();
  say_out_of_memory();
  messages().flush(Outlet::kPatience);
  end_at_once(kExitInternal);
}

}  // namespace

Command absent(const char* name) {
  return {name, "Not in this build", kHowToGetAll, define_absent};
}

int run_program(int argc, char** argv) {
  std::set_terminate(on_terminate);
  std::set_new_handler(on_new_failed);
  make_writes_fail();
  try {
    try {
      return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::filesystem::filesystem_error& error) {
      // Such as a name that is too long, or a link to itself.
      print_error(fmt::format("cannot use '{}': {}", printable(error.path1().string()),
                              error.code().message()));
      return kExitUsage;
    } catch (const std::exception& error) {
      print_error(error.what(), "this is a bug in lockstep; please report it");
    }
  } catch (const std::bad_alloc&) {
    say_out_of_memory();
  }
  return kExitInternal;
}

}  // namespace lockstep::host
