#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/core/suggest.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "base/system/descriptors.h"
#include "base/system/output_file.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "record/read/recording_parts.h"
#include "record/use/recording_merge.h"
#include "record/use/team_clocks.h"

namespace lockstep::host {
namespace {

struct LogMergeOptions {
  std::vector<std::string> files;
  std::string out;
  std::vector<std::string> offsets;  // NAME=SECONDS
};

// One of those that a run had, which may have been cut and continued.
struct RobotProcess {
  TeamWords words = {};
  double pause = 0;  // in seconds, since the process before it, as its header has it
  std::optional<ClockFit> clock = {};
};

// A robot, from its recording, which is read twice.
struct RobotFile {
  std::string path;
  std::unique_ptr<NamedRecording> file = {};
  std::unique_ptr<RecordingReader> reader = {};
  std::vector<Membership> teams = {};
  std::vector<RobotProcess> processes = {};
  std::string name = {};
  std::optional<double> offset = {};  // that the user gives

  const RobotProcess& first() const { return processes.front(); }
  double began() const { return first().clock->began; }

  // An exit code.
  int open() {
    std::error_code error;
    if (path == "-" || std::filesystem::is_fifo(path, error)) {
      return usage_error(fmt::format("cannot merge '{}': a recording is read twice, from a file",
                                     printable(path)));
    }
    if (std::filesystem::is_directory(path, error)) return cannot_use("read", path, EISDIR);
    reader.reset();
    file = std::make_unique<NamedRecording>(path);
    if (!file->is_open()) return cannot_use("read", path, errno);
    reader = std::make_unique<RecordingReader>(file->text(), path);
    return reader->error().empty() ? kExitSuccess : report_end(*reader);
  }

  int read_words() {
    if (const int code = open(); code != kExitSuccess) return code;
    const RecordingHeader& header = reader->header();
    if (is_merged(header)) {
      print_error(fmt::format("{}: it is the recording of a team already", printable(path)),
                  "merge the recordings of its robots");
      return kExitUsage;
    }
    teams = memberships_of(header);
    if (teams.empty()) {
      print_error(fmt::format("{}: the robot is in no team", printable(path)),
                  "merge the recordings of runs of trees with a <team>");
      return kExitUsage;
    }
    name = teams.front().self;
    const bool is_part = header.resumed_after.has_value();
    add_process({.first_tick = is_part ? header.first_tick : 0, .after = 0, .run = header.run});
    bool has_ticks = false;
    const auto follow_cuts = [&] {
      const auto cuts = std::span(reader->resumes()).subspan(is_part ? 1 : 0);
      while (processes.size() <= cuts.size()) add_process(cuts[processes.size() - 1]);
    };
    while (const auto tick = reader->next()) {
      follow_cuts();
      processes.back().words.add(*tick);
      has_ticks = true;
    }
    follow_cuts();
    if (!reader->error().empty()) return report_end(*reader);
    if (has_ticks) return kExitSuccess;
    return usage_error(fmt::format("{}: the recording has no ticks", printable(path)));
  }

  void add_process(const RecordingReader::Resume& from) {
    TeamWords words{.run = from.run, .first_tick = from.first_tick};
    words.is_real = reader->header().clock == "wall";
    processes.push_back({.words = std::move(words), .pause = from.after});
  }
};

using RobotFiles = std::deque<RobotFile>;

bool share_a_run(const RobotFile& one, const RobotFile& other) {
  return std::ranges::any_of(one.processes, [&](const RobotProcess& it) {
    const auto is_same = [&](const RobotProcess& to) { return to.words.run == it.words.run; };
    return it.words.run != 0 && std::ranges::any_of(other.processes, is_same);
  });
}

bool share_a_team(const RobotFile& one, const RobotFile& other) {
  return std::ranges::any_of(one.teams, [&](const Membership& it) {
    return std::ranges::find(other.teams, it.team, &Membership::team) != other.teams.end();
  });
}

// A member whose program was started again has several recordings: right, right#2.
int name_robots(RobotFiles& robots) {
  std::map<std::string, int> count;
  for (auto it = robots.begin(); it != robots.end(); ++it) {
    for (auto before = robots.begin(); before != it; ++before) {
      if (!share_a_run(*before, *it)) continue;
      print_error(fmt::format("'{}' and '{}' are recordings of the same run of '{}'",
                              printable(before->path), printable(it->path), printable(it->name)),
                  "of a recording in parts, give the name that --record got");
      return kExitUsage;
    }
    const bool is_of_team = std::ranges::any_of(
        robots, [&](const RobotFile& other) { return &other != &*it && share_a_team(*it, other); });
    if (!is_of_team) {
      return usage_error(fmt::format("{}: no other recording is of its team '{}'",
                                     printable(it->path), printable(it->teams.front().team)));
    }
    const int number = ++count[it->name];
    if (number > 1) it->name += fmt::format("#{}", number);
  }
  return kExitSuccess;
}

int take_offsets(const LogMergeOptions& options, RobotFiles& robots) {
  for (const std::string& text : options.offsets) {
    const auto equals = text.rfind('=');
    const auto seconds =
        equals == std::string::npos ? std::nullopt : parse_double(text.substr(equals + 1));
    if (!seconds || !(std::abs(*seconds) <= 1e9)) {
      print_error(fmt::format("--offset {}: not a name and a time", printable(text)),
                  "NAME=SECONDS, such as right=0.5");
      return kExitUsage;
    }
    const std::string name = text.substr(0, equals);
    const auto it = std::ranges::find(robots, name, &RobotFile::name);
    if (it == robots.end()) {
      std::vector<std::string_view> known;
      for (const RobotFile& robot : robots) known.push_back(robot.name);
      print_error(fmt::format("--offset {}: no recording is of this robot", printable(text)),
                  suggest(name, known, "there are"));
      return kExitUsage;
    }
    if (it == robots.begin()) {
      return usage_error(
          fmt::format("--offset {}: times are those of the first recording, which is this one",
                      printable(text)));
    }
    it->offset = seconds;
  }
  return kExitSuccess;
}

// "'right' began 0.500 s ± 0.012 s after 'left'", rounded so that it stays true.
std::string began_text(const RobotFile& robot, const RobotFile& first, const ClockFit& clock) {
  constexpr double kStep = 0.001;
  const double uncertainty = std::ceil(clock.uncertainty / kStep + 0.5) * kStep;
  return fmt::format("'{}' began {:.3f} s ± {:.3f} s {} '{}'", robot.name, std::abs(clock.began),
                     uncertainty, clock.began < 0 ? "before" : "after", first.name);
}

// What a person may do where the words do not say enough.
int cannot_place(const RobotFiles& robots, const RobotFile& robot) {
  const RobotFile& first = robots.front();
  const std::string hint =
      fmt::format("--offset {}=SECONDS: how long after '{}' it began, negative for before",
                  robot.name, first.name);
  const ClockBounds bounds =
      clock_bounds(first.first().words, *first.first().clock, robot.first().words);
  const bool has_words = std::ranges::any_of(
      robots, [](const RobotFile& it) { return !it.first().words.heard.empty(); });
  std::string why = fmt::format("the recordings do not show when '{}' began: ", robot.name);
  if (robot.first().words.run == 0) {
    why += "its recording was made by a version of lockstep that did not record what is heard";
  } else if (std::isfinite(bounds.least)) {
    why += fmt::format(
        "the others have heard nothing of this run, so it began at least {:.3f} s "
        "after '{}' did",
        bounds.least, first.name);
  } else if (std::isfinite(bounds.most)) {
    why += fmt::format(
        "it has heard nothing of the others, so it began at most {:.3f} s after "
        "'{}' did",
        bounds.most, first.name);
  } else {
    why += has_words ? "none of them has heard another of these runs" : "none has heard another";
  }
  print_error(printable(why), printable(hint));
  return kExitUsage;
}

// By the process of another robot, of those that have a place already, with which it is the most
// certain. False: what they have heard of each other contradicts itself.
bool place_by_words(const RobotFiles& robots, const RobotFile& robot, RobotProcess& process,
                    const RobotFile*& other_robot) {
  for (const RobotFile& other : robots) {
    if (&other == &robot) continue;
    for (const RobotProcess& it : other.processes) {
      if (!it.clock) continue;
      const ClockBounds bounds = clock_bounds(it.words, *it.clock, process.words);
      if (!bounds.is_closed()) continue;
      other_robot = &other;
      if (bounds.least > bounds.most) return false;
      ClockFit fit = bounds.fit();
      fit.uncertainty += it.clock->uncertainty;
      if (!process.clock || fit.uncertainty < process.clock->uncertainty) process.clock = fit;
    }
  }
  return true;
}

// Where words in one direction only do not contradict it, a pause is as long as the header has it.
ClockFit beyond_cut(const RobotFiles& robots, const RobotFile& robot, const RobotProcess& process,
                    const ClockFit& from, double pause) {
  ClockBounds all;
  for (const RobotFile& other : robots) {
    for (const RobotProcess& it : other.processes) {
      if (&other == &robot || !it.clock) continue;
      const ClockBounds bounds = clock_bounds(it.words, *it.clock, process.words);
      all.least = std::max(all.least, bounds.least);
      all.most = std::min(all.most, bounds.most);
    }
  }
  ClockFit fit = from;
  fit.began = std::max(std::min(from.began + pause, all.most), all.least);
  return fit;
}

// The first one that a cut parts from a process that has a place.
bool place_by_cut(RobotFiles& robots) {
  for (RobotFile& robot : robots) {
    auto& all = robot.processes;
    for (std::size_t i = 1; i < all.size(); ++i) {
      RobotProcess &before = all[i - 1], &after = all[i];
      if (before.clock.has_value() == after.clock.has_value()) continue;
      if (before.clock) {
        after.clock = beyond_cut(robots, robot, after, *before.clock, after.pause);
      } else {
        before.clock = beyond_cut(robots, robot, before, *after.clock, -after.pause);
      }
      return true;
    }
  }
  return false;
}

int place(RobotFiles& robots) {
  robots.front().processes.front().clock.emplace();
  for (RobotFile& it : robots) {
    if (!it.offset) continue;
    double began = *it.offset;
    for (RobotProcess& process : it.processes)
      process.clock = ClockFit{.began = began += process.pause};
  }
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (RobotFile& robot : robots) {
      for (RobotProcess& process : robot.processes) {
        if (process.clock) continue;
        const RobotFile* other = nullptr;
        if (!place_by_words(robots, robot, process, other)) {
          print_error(
              fmt::format("what '{}' and '{}' have heard of each other does not fit one clock: "
                          "one was stopped or set",
                          printable(robot.name), printable(other->name)),
              fmt::format("--offset {}=SECONDS: how long after '{}' it began",
                          printable(robot.name), printable(robots.front().name)));
          return kExitUsage;
        }
        goes_on |= process.clock.has_value();
      }
    }
    if (!goes_on) goes_on = place_by_cut(robots);
  }
  const auto unplaced =
      std::ranges::find_if(robots, [](const RobotFile& it) { return !it.first().clock; });
  return unplaced == robots.end() ? kExitSuccess : cannot_place(robots, *unplaced);
}

void tell_clocks(const RobotFiles& robots) {
  const RobotFile& first = robots.front();
  for (const RobotFile& it : robots) {
    if (&it == &first) continue;
    const ClockFit& clock = *it.first().clock;
    if (!it.offset) {
      std::string text = began_text(it, first, clock);
      if (clock.drift != 0) {
        text += fmt::format(", and its clock is {:.0f} ppm {}", std::abs(clock.drift) * 1e6,
                            clock.drift < 0 ? "fast" : "slow");
      }
      print_note(printable(text));
      continue;
    }
    const ClockBounds bounds =
        clock_bounds(first.first().words, *first.first().clock, it.first().words);
    if (*it.offset >= bounds.least && *it.offset <= bounds.most) continue;
    print_note(printable(
        bounds.is_closed() && bounds.least <= bounds.most
            ? fmt::format("--offset {}={}: by what they have heard, {}", it.name, *it.offset,
                          began_text(it, first, bounds.fit()))
            : fmt::format("--offset {}={}: one has heard a word before the other one sent it",
                          it.name, *it.offset)));
  }
}

void tell_rates(const RobotFiles& robots) {
  const auto rate = [](const RobotFile& it) { return it.reader->header().rate_hz; };
  const RobotFile& fastest = *std::ranges::max_element(robots, {}, rate);
  for (const RobotFile& it : robots) {
    if (rate(it) == rate(fastest)) continue;
    print_note(printable(fmt::format(
        "'{}' ticks at {} Hz, and '{}' at {} Hz: take measures of '{}' from its own recording",
        it.name, rate(it), fastest.name, rate(fastest), it.name)));
  }
}

std::string team_of(const RobotFiles& robots) {
  std::vector<std::string> names;
  for (const RobotFile& it : robots) {
    for (const Membership& team : it.teams) {
      if (std::ranges::find(names, team.team) == names.end()) names.push_back(team.team);
    }
  }
  return joined(names, "+");
}

int merge_to(const LogMergeOptions& options, RobotFiles& robots) {
  double earliest = 0;
  for (const RobotFile& it : robots) earliest = std::min(earliest, it.began());
  std::vector<RobotRecording> recordings;
  for (RobotFile& it : robots) {
    if (const int code = it.open(); code != kExitSuccess) return code;
    std::vector<ClockFit> clocks;
    for (const RobotProcess& process : it.processes) {
      clocks.push_back(*process.clock);
      clocks.back().began -= earliest;
    }
    const bool is_followed = std::ranges::any_of(robots, [&](const RobotFile& other) {
      const bool is_same = other.teams.front().self == it.teams.front().self;
      return is_same && other.began() > it.began();
    });
    recordings.push_back({.reader = it.reader.get(),
                          .name = it.name,
                          .is_followed = is_followed,
                          .clocks = std::move(clocks)});
  }
  tell_rates(robots);
  const auto report = [&] {
    for (const RobotFile& it : robots) {
      const RecordingOutcome outcome = it.reader->outcome();
      if (!outcome.error.empty()) return report_end(outcome);
      const auto note = [&](std::string_view text) {
        print_note(printable(fmt::format("'{}': {}", it.name, text)));
      };
      if (!outcome.gaps.empty()) note(outcome.gaps);
      if (!outcome.cut.empty()) note("the recording is cut: " + outcome.cut);
    }
    return int{kExitSuccess};
  };
  const std::string team = team_of(robots);
  if (options.out.empty()) {
    int written = kExitSuccess;
    merge_recordings(team, recordings, [&](std::string_view line) {
      written = write_results(line);
      return written == kExitSuccess;
    });
    return first_failure(report(), written);
  }
  OutputFile out(options.out);
  if (out.descriptor() < 0) return usage_error(printable(out.error()));
  int reason = 0;
  merge_recordings(team, recordings, [&](std::string_view line) {
    if (!write_all(out.descriptor(), line)) reason = errno;
    return reason == 0;
  });
  const int code = report();
  if (reason == 0 && code == kExitSuccess && !out.take_name()) reason = errno;
  return reason == 0 ? code : cannot_use("write", options.out, reason);
}

int merge(const LogMergeOptions& options) {
  RobotFiles robots;
  for (const std::string& path : options.files) {
    if (!options.out.empty() && would_overwrite("--out", options.out, files_of(path))) {
      return kExitUsage;
    }
    robots.push_back({.path = path});
    if (const int code = robots.back().read_words(); code != kExitSuccess) return code;
  }
  if (const int code = name_robots(robots); code != kExitSuccess) return code;
  if (const int code = take_offsets(options, robots); code != kExitSuccess) return code;
  if (const int code = place(robots); code != kExitSuccess) return code;
  tell_clocks(robots);
  return merge_to(options, robots);
}

}  // namespace

LogSubcommand define_log_merge(CLI::App& log) {
  const auto options = std::make_shared<LogMergeOptions>();
  CLI::App* app = log.add_subcommand(
      "merge", "Make one recording of those of the robots of a team, on one clock");
  app->add_option("files", options->files, "A recording of each robot, two or more")
      ->type_name("FILE.jsonl")
      ->required()
      ->expected(2, 1000);
  app->add_option("--out,-o", options->out, "Write the recording to this file instead of stdout")
      ->type_name("FILE");
  app->add_option("--offset", options->offsets,
                  "How many seconds after the robot of the first recording NAME began (default: "
                  "estimated from what the robots have heard of each other). May be repeated")
      ->type_name("NAME=SECONDS")
      ->allow_extra_args(false);
  return {app, [options] { return merge(*options); }};
}

}  // namespace lockstep::host
