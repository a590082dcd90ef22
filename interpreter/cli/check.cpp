#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/loading.h"
#include "core/printable_json.h"

namespace lockstep {
namespace {

struct CheckOptions {
  LoadOptions load;
  std::vector<std::string> trees;
  std::string format = "human";
};

nlohmann::ordered_json to_json(const Diagnostic& diagnostic) {
  return {{"severity", to_string(diagnostic.severity)},
          {"file", diagnostic.location.file},
          {"line", diagnostic.location.line},
          {"column", diagnostic.location.column},
          {"message", diagnostic.message},
          {"hint", diagnostic.hint}};
}

int check(const CheckOptions& options) {
  keep_stdout_for_results();
  const bool json = options.format == "json";
  auto all = nlohmann::ordered_json::array();
  int worst = kExitSuccess, written = kExitSuccess;
  for (const std::string& tree : options.trees) {
    Loaded loaded;
    Diagnostics diagnostics;
    const int code = load(tree, options.load, loaded, diagnostics);
    if (worst == kExitSuccess) worst = code;
    if (json) {
      diagnostics.sort();
      for (const Diagnostic& diagnostic : diagnostics.all()) all.push_back(to_json(diagnostic));
      continue;
    }
    print_diagnostics(diagnostics, Severity::Note);
    if (code == kExitSuccess && written == kExitSuccess) {
      const std::string& path = loaded.project->documents.front()->path();
      written = write_results(printable(path) + ": ok\n");
    }
  }
  if (json) {
    constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
    written = write_results(printable_json(all.dump(2, ' ', false, kReplace)) + "\n");
  }
  return first_failure(written, worst);
}

std::function<int()> define_check(CLI::App& app) {
  const auto options = std::make_shared<CheckOptions>();
  app.add_option("tree", options->trees, "Tree files; - is stdin")
      ->type_name("TREE.xml")
      ->required();
  app.add_option("--format", options->format, "human, or json: an array of messages on stdout")
      ->check(CLI::IsMember({"human", "json"}))
      ->capture_default_str();
  add_load_options(app, options->load);
  return [options] { return check(*options); };
}

}  // namespace

const Command kCheckCommand{
    "check", "Tell all that is wrong with tree files, and what is doubtful, without running them",
    "Messages go to stderr as file:line:column; with --format json they go to stdout.\n"
    "Exit code: 0 no errors, 3 invalid tree, 4 plugin refused, 2 usage.\n"
    "\n"
    "Examples:\n"
    "  lockstep check trees/*.xml\n"
    "  lockstep check --format json trees/door_pulling.xml",
    define_check};

}  // namespace lockstep
