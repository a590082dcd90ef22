#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <memory>

#include "base/core/wording.h"
#include "base/json/json.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "run/checkpoint/checkpoint_file.h"
#include "run/checkpoint/run_bytes.h"

namespace lockstep::host {
namespace {

struct CheckpointCommandOptions {
  std::string file;
  bool json = false;
};

std::string_view name_of(Checkpoint::Kind kind) {
  if (kind == Checkpoint::Kind::Unfinished) return "unfinished";
  return kind == Checkpoint::Kind::Ended ? "ended" : "lost";
}

// Of each node, or of none.
std::vector<Activity> activities_of(const KeptCheckpoint& kept) {
  std::vector<Activity> found = activities_in(kept.checkpoint.run);
  if (found.size() != kept.facts.nodes.size()) found.clear();
  return found;
}

Json json_of(const KeptCheckpoint& kept) {
  const Checkpoint& it = kept.checkpoint;
  Json identity = Json::object();
  for (const auto& [name, value] : kept.facts.identity) identity.add(name, value);
  Json nodes = Json::array();
  const std::vector<Activity> activities = activities_of(kept);
  for (std::size_t node = 0; node < activities.size(); ++node) {
    nodes.push_back({{"path", kept.facts.nodes[node]},
                     {"status", to_string(status_of(activities[node]))},
                     {"held", activities[node] == Activity::Paused},
                     {"leaf", kept.facts.is_leaf[node] != 0}});
  }
  return {{"state", name_of(it.kind)},     {"ticks", it.ticks},
          {"time_s", to_seconds(it.time)}, {"written_s", to_seconds(it.written)},
          {"resumes", it.resumes},         {"note", it.note},
          {"identity", identity},          {"nodes", nodes}};
}

std::string text_of(const KeptCheckpoint& kept) {
  const Checkpoint& it = kept.checkpoint;
  std::string text = fmt::format("{} after {}, {:.3f} s of the run", name_of(it.kind),
                                 counted(it.ticks, "tick"), to_seconds(it.time));
  const auto written = static_cast<std::time_t>(to_seconds(it.written));
  std::tm date{};
  char words[32] = "";
  if (gmtime_r(&written, &date) != nullptr) {
    std::strftime(words, sizeof words, "%Y-%m-%d %H:%M:%S UTC", &date);
  }
  text += fmt::format("\nwritten {}\n", words);
  if (!it.note.empty()) text += fmt::format("{}\n", printable(it.note));
  if (it.resumes != 0) {
    text +=
        fmt::format("resumed {} in a row without a completed leaf\n", counted(it.resumes, "time"));
  }
  const std::vector<Activity> activities = activities_of(kept);
  for (std::size_t node = 0; node < activities.size(); ++node) {
    if (status_of(activities[node]) != Status::Running || kept.facts.is_leaf[node] == 0) continue;
    text += fmt::format("{} is {}\n", printable(kept.facts.nodes[node]),
                        activities[node] == Activity::Paused ? "held" : "running");
  }
  for (const auto& [name, value] : kept.facts.identity) {
    text += fmt::format("{}: {}\n", printable(name), printable(value));
  }
  return text;
}

int show(const CheckpointCommandOptions& options) {
  const auto kept = read_checkpoint_file(options.file, CheckpointReader::Shows);
  if (!kept || !*kept) {
    print_error(kept ? fmt::format("there is no file '{}'", printable(options.file))
                     : printable(kept.error().message));
    return kExitUsage;
  }
  return write_results(options.json ? json_of(**kept).printable(2) + "\n" : text_of(**kept));
}

std::function<int()> define_checkpoint(CLI::App& app) {
  const auto options = std::make_shared<CheckpointCommandOptions>();
  app.add_option("file", options->file, "What `lockstep run --checkpoint` has written")
      ->type_name("FILE")
      ->required();
  app.add_flag("--json", options->json, "Print it as JSON");
  return [options] { return show(*options); };
}

}  // namespace

extern const Command kCheckpointCommand{
    "checkpoint", "Show the checkpoint of a run",
    "Prints whether the run has ended, what runs in it, and of which tree it is.\n"
    "Exit code: 0 printed, 2 usage, or the file is not a checkpoint.\n"
    "\n"
    "Examples:\n"
    "  lockstep checkpoint run.checkpoint\n"
    "  lockstep checkpoint run.checkpoint --json",
    define_checkpoint};

}  // namespace lockstep::host
