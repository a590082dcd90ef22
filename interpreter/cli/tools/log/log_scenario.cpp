#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/recorded_tree.h"
#include "scenario/recorded_words.h"
#include "scenario/scenario_writer.h"

namespace lockstep::host {
namespace {

struct LogScenarioOptions {
  std::string file;
  std::string tree;  // "": as the recording names it
  std::string name;  // "": that of the recording
  std::string save;  // "": stdout
  PluginOptions plugins;
};

int write_scenario(const LogScenarioOptions& options, const RecordingHeader& header) {
  const RecordedTree recorded(header, options.tree, options.plugins);
  if (recorded.code() != kExitSuccess) return recorded.code();
  const ScenarioTree of{recorded.file(), recorded.main(), header.id};
  const auto tree = options.save.empty() ? Result<std::string>(std::string())
                                         : tree_in_scenario_file(options.save, of);
  if (!tree) return refuse(tree.error());
  RecordedWords words = read_recorded_words(options.file, recorded.tree());
  if (words.lacks_ticks) words.outcome.gaps.clear();  // a note says more
  if (const int code = report_end(words.outcome); code != kExitSuccess) return code;
  const std::string name =
      options.name.empty()
          ? fmt::format("as in {}", std::filesystem::path(options.file).filename().string())
          : options.name;
  for (const std::string& it : words.notes) print_note(it);
  const std::string text = to_text(
      words, {.name = name, .comments = words.notes, .tree = *tree, .main = recorded.main()});
  if (!options.save.empty()) {
    const auto saved = add_to_scenario_file(options.save, of, text);
    return saved ? kExitSuccess : refuse(saved.error());
  }
  const auto file = scenario_file(recorded.file(), text);
  return file ? write_results(*file) : refuse(file.error());
}

int scenario(const LogScenarioOptions& options) {
  keep_stdout_for_results();
  if (options.file == "-") {
    return usage_error("log scenario reads the recording twice: name a file");
  }
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    return write_scenario(options, reader.header());
  });
}

}  // namespace

LogSubcommand define_log_scenario(CLI::App& log) {
  const auto options = std::make_shared<LogScenarioOptions>();
  CLI::App* app =
      log.add_subcommand("scenario", "Write a scenario in which the leaves do what they did");
  add_recording_file(*app, options->file);
  app->add_option("tree", options->tree, "The tree file (default: as the recording names it)")
      ->type_name("TREE.xml");
  app->add_option("--name", options->name, "The name of the scenario")->type_name("NAME");
  app->add_option(
         "--save", options->save,
         "Append the scenario to this file, which is made if it is missing, instead of stdout")
      ->type_name("FILE.test.xml");
  add_plugin_options(*app, options->plugins);
  add_program_option(*app, options->plugins);
  app->footer(
      "A bug on the robot becomes a test: `lockstep test` plays it, and expects that it ends as "
      "it\n"
      "did. Change that to the result that you expect.\n"
      "Exit code: 0 written, 2 usage, 3 not a recording or a damaged one, or an invalid tree,\n"
      "4 plugin refused.\n"
      "\n"
      "Example:\n"
      "  lockstep log scenario run.jsonl --save tree.test.xml --name 'the jam of Monday'");
  return {app, [options] { return scenario(*options); }};
}

}  // namespace lockstep::host
