#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "core/descriptors.h"
#include "core/diagnostics.h"
#include "core/output_file.h"
#include "core/wording.h"
#include "loading/plugin_directories.h"
#include "plugin/plugin_path.h"
#include "plugin/program/conformance.h"
#include "plugin/program/leaves_file.h"

namespace lockstep {
namespace {

struct PluginCheckOptions {
  std::string file;
  PluginOptions plugins;
  bool save = false;
};

int save_leaves(const std::string& program, const std::string& line) {
  const std::string path = leaves_file_of(program);
  OutputFile out(path);
  const bool is_written = out.descriptor() >= 0 && write_all(out.descriptor(), line + "\n");
  if (is_written && out.take_name()) return kExitSuccess;
  print_error(out.error().empty() ? fmt::format("cannot write '{}'", path)
                                  : printable(out.error()));
  return kExitUsage;
}

// A file, else a name that is searched as `--plugin` does; "" when there is no program.
std::string find_program(const PluginCheckOptions& options) {
  if (is_executable(options.file)) return options.file;
  if (options.file.find('/') != std::string::npos) return {};
  const auto directories = plugin_directories(options.plugins);
  const std::string file = program_named(options.file, directories);
  return file.empty() ? file : find_program_file(file, directories).value_or("");
}

int check_program(const PluginCheckOptions& options) {
  keep_stdout_for_results();
  const std::string program = find_program(options);
  if (program.empty()) {
    print_error(
        fmt::format("'{}' is not a program", printable(options.file)),
        "give an executable file, with chmod +x and #! in the first line of a script; or the "
        "name of one in a directory of --plugin-path or LOCKSTEP_PLUGIN_PATH");
    return kExitUsage;
  }
  const Conformance found = check_conformance(program, isolation_options(options.plugins));
  std::string text;
  for (const ConformanceStep& step : found.steps) {
    text += fmt::format("{} {}\n", step.is_good ? "ok   " : "wrong", printable(step.text));
  }
  const std::string name = printable(program);
  text += found.is_good()
              ? fmt::format("{}: ok\n", name)
              : fmt::format("{}: does not keep the protocol (docs/programs.md)\n", name);
  const int code = found.is_good() ? kExitSuccess : kExitPluginRefused;
  const int saved =
      options.save && found.is_good() ? save_leaves(program, found.first_line) : kExitSuccess;
  return first_failure(first_failure(write_results(text), saved), code);
}

std::function<int()> define_plugin(CLI::App& app) {
  const auto options = std::make_shared<PluginCheckOptions>();
  app.require_subcommand(1);
  CLI::App* check = app.add_subcommand(
      "check",
      "Start a program that is a plugin, and ask each of its leaves all that a run may ask");
  check->add_option("program", options->file, "The file of the program, or a name to search for")
      ->type_name("FILE|NAME")
      ->required();
  check->add_flag("--save", options->save,
                  "Write what leaves it has to a file beside it, grip.leaves.json for grip.py, "
                  "which commands read that run no programs");
  check
      ->add_option("--plugin-path", options->plugins.directories,
                   "Search the program in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  check
      ->add_option("--hang-limit", options->plugins.hang_limit,
                   "Wait for an answer so many seconds; 0 = for ever")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  return [options] { return check_program(*options); };
}

}  // namespace

const Command kPluginCommand{"plugin", "Check a plugin that is a program",
                             "Exit code: 0 it keeps the protocol, 4 it does not, 2 usage.\n"
                             "\n"
                             "Examples:\n"
                             "  lockstep plugin check ./grip.py\n"
                             "  lockstep plugin check grip --plugin-path leaves\n"
                             "  lockstep plugin check ./grip.py --save",
                             define_plugin};

}  // namespace lockstep
