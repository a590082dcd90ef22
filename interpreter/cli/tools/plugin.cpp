#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "base/core/diagnostics.h"
#include "base/system/output_file.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/plugin_check/object_check.h"
#include "leaves/plugin/open/plugin_path.h"
#include "leaves/remote/json_lines/conformance.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "run/loading/load.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

struct PluginCheckOptions {
  std::string file;
  PluginOptions plugins;
  bool save = false;
  std::vector<std::string> trees;  // whose elements are saved, too
  bool only_leaves = false;
  std::optional<std::size_t> from_leaf;  // in the child that examines a shared object
};

// The program's answers about elements of the trees, after its first line; nothing after errors.
std::optional<std::string> describe_elements(const PluginCheckOptions& options,
                                             const std::string& program) {
  LoadOptions load_options;
  load_options.plugins = options.plugins;
  load_options.plugins.run_programs = true;
  const auto folder = std::filesystem::path(program).parent_path();
  load_options.plugins.directories.insert(load_options.plugins.directories.begin(),
                                          folder.empty() ? "." : folder.string());
  const auto plugins = std::make_shared<PluginSet>();
  bool is_good = true;
  for (const std::string& tree : options.trees) {
    Diagnostics diagnostics;
    is_good &= load(tree, load_options, diagnostics, plugins).has_value();
    print_diagnostics(diagnostics, Severity::Error);
  }
  if (!is_good) return std::nullopt;
  std::string all;
  for (const PluginSet::Info& it : plugins->list()) {
    std::error_code error;
    if (std::filesystem::equivalent(it.path, program, error)) all += it.descriptions;
  }
  return all;
}

int save_leaves(const PluginCheckOptions& options, const std::string& program,
                const std::string& line) {
  const auto described = describe_elements(options, program);
  if (!described) return kExitInvalidTree;
  const auto done = write_output(leaves_file_of(program), line + "\n" + *described);
  if (done) return kExitSuccess;
  print_error(printable(done.error().message));
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

// The same of a shared object.
std::string find_object(const PluginCheckOptions& options) {
  const bool is_file = std::filesystem::is_regular_file(options.file);
  if (is_file) return options.file.ends_with(".so") ? options.file : "";
  if (options.file.find('/') != std::string::npos) return {};
  return find_plugin_file(options.file, plugin_directories(options.plugins)).value_or("");
}

int refuse_file(const PluginCheckOptions& options) {
  if (options.file.find('/') != std::string::npos && !std::filesystem::exists(options.file)) {
    print_error(fmt::format("there is no file '{}'", printable(options.file)));
    return kExitUsage;
  }
  print_error(fmt::format("'{}' is not a plugin", printable(options.file)),
              "give a shared object, or an executable file, with chmod +x and #! in the first line "
              "of a script; or the name of one in a directory of --plugin-path or "
              "LOCKSTEP_PLUGIN_PATH");
  return kExitUsage;
}

std::string text_of(const Conformance& found, const std::string& file, std::string_view contract) {
  std::string text;
  for (const ConformanceStep& step : found.steps) {
    text += fmt::format("{} {}\n", step.is_good ? "ok   " : "wrong", printable(step.text));
  }
  if (!found.has_started) return text + fmt::format("{}: was not examined\n", printable(file));
  return text + (found.is_good()
                     ? fmt::format("{}: ok\n", printable(file))
                     : fmt::format("{}: does not keep {}\n", printable(file), contract));
}

int check_object(const PluginCheckOptions& options, const std::string& file) {
  if (options.save || options.only_leaves) {
    print_error(options.save ? "--save is for programs" : "--list is for programs",
                "commands read what a shared object has from itself");
    return kExitUsage;
  }
  const Conformance found = check_object(file, options.plugins);
  const int code = found.is_good() ? kExitSuccess : kExitPluginRefused;
  const std::string text = text_of(found, file, "the contract (`lockstep docs plugins`)");
  return first_failure(write_results(text), code);
}

int check_plugin(const PluginCheckOptions& options) {
  if (options.from_leaf) return examine_object(options.file, options.plugins, *options.from_leaf);
  keep_stdout_for_results();
  const std::string object = find_object(options);
  if (!object.empty()) return check_object(options, object);
  const std::string program = find_program(options);
  if (program.empty()) return refuse_file(options);
  const auto part = options.only_leaves ? ConformancePart::Begin : ConformancePart::All;
  const Conformance found = check_conformance(program, isolation_options(options.plugins), part);
  const std::string text = text_of(found, program, "the protocol (`lockstep docs programs`)");
  const int code = found.is_good() ? kExitSuccess : kExitPluginRefused;
  const int saved = options.save && found.is_good()
                        ? save_leaves(options, program, found.first_line)
                        : kExitSuccess;
  return first_failure(first_failure(write_results(text), saved), code);
}

std::function<int()> define_plugin(CLI::App& app) {
  const auto options = std::make_shared<PluginCheckOptions>();
  app.require_subcommand(1);
  CLI::App* check =
      app.add_subcommand("check",
                         "Load a plugin in another process, or start a process plugin, and make "
                         "each call to its leaves that a run may make");
  check->add_option("plugin", options->file, "The file of the plugin, or a name to search for")
      ->type_name("FILE|NAME")
      ->required();
  check->add_flag("--save", options->save,
                  "Write the leaves of a process plugin to a file next to it, grip.leaves.json for "
                  "grip.py, for commands that do not start it");
  check
      ->add_option(
          "--tree", options->trees,
          "With --save, also what ports the program gives to the elements of this tree, of leaf "
          "types with ports by pattern; may be repeated")
      ->type_name("FILE")
      ->needs("--save")
      ->allow_extra_args(false);
  check->add_flag("--list", options->only_leaves,
                  "Only list the leaves of a process plugin: no leaf is started, so nothing moves");
  check
      ->add_option("--plugin-path", options->plugins.directories,
                   "Search the plugin in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  check
      ->add_option("--hang-limit", options->plugins.hang_limit,
                   "The longest wait for an answer or a call, in seconds; 0 = no limit")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  check->add_option("--from-leaf", options->from_leaf)->group("");
  return [options] { return check_plugin(*options); };
}

}  // namespace

extern const Command kPluginCommand{"plugin", "Check a plugin: a shared object or a process plugin",
                                    "Exit code: 0 it keeps the contract, 4 it does not, or does "
                                    "not start, 3 a tree of --tree is wrong, 2 usage.\n"
                                    "\n"
                                    "Examples:\n"
                                    "  lockstep plugin check build/grip.so\n"
                                    "  lockstep plugin check ./grip.py\n"
                                    "  lockstep plugin check grip --plugin-path leaves\n"
                                    "  lockstep plugin check ./grip.py --save\n"
                                    "  lockstep plugin check ./grip.py --list --save",
                                    define_plugin};

}  // namespace lockstep::host
