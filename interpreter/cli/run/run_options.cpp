#include "cli/run/run_options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <utility>
#include <vector>

#include "base/core/deadlines.h"
#include "cli/checks.h"
#include "cli/help_text.h"
#include "cli/load/given_leaves.h"
#include "cli/load/tree_argument.h"
#include "cli/run/rotation.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

constexpr lockstep_log_level kNoLogs = LOCKSTEP_LOG_WARNING + 1;
// A budget that is exceeded before a thread may have looked is none of a TickAlarm.
constexpr Nanoseconds kLeastAlarmed = std::chrono::milliseconds(1);

// Of the options that follow.
void begin_group(CLI::App& app, const char* title) {
  app.option_defaults()->group(title);
}

// An option whose value is one of some words.
template <class T>
void add_choice(CLI::App& app, const std::string& name, T& value,
                const std::vector<std::pair<std::string, T>>& choices, const std::string& doc) {
  const std::map<std::string, T> values(choices.begin(), choices.end());
  std::vector<std::string> words;
  std::string current;
  for (const auto& [word, meaning] : choices) {
    words.push_back(word);
    if (meaning == value) current = word;
  }
  app.add_option_function<std::string>(
         name, [&value, values](const std::string& word) { value = values.at(word); }, doc)
      ->check(one_of(words))
      ->default_str(current);
}

void define_loop_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Time");
  app.add_option("--rate", options.rate, "Ticks per second")
      ->type_name("HZ")
      ->check(number_between(0.001, 100000.0))
      ->each([&options](const std::string&) { options.is_rate_given = true; })
      ->capture_default_str();
  app.add_option(
         "--clock", options.clock,
         "wall: real time; virtual: as fast as the machine allows; ros: the topic /clock of "
         "ROS 2, with the plugin ros2")
      ->check(one_of({"wall", "virtual", "ros"}))
      ->capture_default_str();
  app.add_option("--seed", options.seed,
                 "The seed of the leaves' random numbers: the same seed gives the same numbers")
      ->type_name("N")
      ->transform(whole_number())
      ->capture_default_str();
  app.add_option(
         "--max-ticks", options.max_ticks,
         "Stop after N ticks, at least 1 (default on the virtual clock: 1000000, unless there is a "
         "--timeout)")
      ->type_name("N")
      ->transform(whole_number(1));
  app.add_option("--timeout", options.timeout, "Stop after S seconds of the run's clock")
      ->type_name("S")
      ->check(number_between(0.0, 1e9));
  app.add_option("--stall", options.stall,
                 "Report a child that makes no progress for S seconds while others wait for it, "
                 "and barriers that wait for each other; 0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  app.add_option("--stall-fail", options.stall_fail,
                 "After S seconds of such a stall, halt the node that makes no progress; it fails; "
                 "0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
}

void add_processors(CLI::App& app, const std::string& name, std::optional<Processors>& to,
                    const std::string& help) {
  app.add_option_function<std::string>(
         name,
         [name, &to](const std::string& text) {
           to = Processors::parse(text);
           if (to) return;
           throw CLI::ValidationError(name,
                                      "'" + text + "' is not a list of processors, as 3 or 0-1,3");
         },
         help)
      ->type_name("LIST");
}

void define_time_options(CLI::App& app, RunCommandOptions& options) {
  add_choice<OverrunPolicy>(app, "--overrun", options.overrun,
                            {{"skip", OverrunPolicy::Skip},
                             {"catch-up", OverrunPolicy::CatchUp},
                             {"fail", OverrunPolicy::Fail}},
                            "When a tick ends after the next deadline: skip the missed "
                            "deadlines, run the missed ticks at once, or end the run");
  add_choice<bool>(app, "--tick", options.exactly_once, {{"once", false}, {"exactly-once", true}},
                   "When a node of a tree for BehaviorTree.CPP requests another tick: tick the "
                   "tree again at once, or in the next period");
  app.add_option("--tick-budget", options.tick_budget_ms,
                 "Report a leaf that takes longer than MS milliseconds; 0 = do not time leaves "
                 "(default: the period, at least 1)")
      ->type_name("MS")
      ->check(number_between(0.0, 1e9));
  app.add_flag(
      "--time-calls", options.times_calls,
      "Time each call of a leaf, not only those of some ticks: exact times in the summary, "
      "for a longer tick");
  app.add_flag("--realtime", options.realtime.realtime,
               "Tick with real-time priority (SCHED_FIFO), memory locked and timer slack 1 ns; "
               "needs privileges");
  app.add_option("--priority", options.realtime.priority, "The priority of --realtime, 1 to 99")
      ->type_name("N")
      ->transform(whole_number(1, 99))
      ->needs("--realtime")
      ->capture_default_str();
  add_processors(app, "--cpu", options.realtime.processors,
                 "Tick on these processors only, counted from 0, such as 3 or 0-1,3");
  add_processors(
      app, "--helper-cpu", options.helper_processors,
      "The processors of lockstep's other threads, which record, watch and serve (default: any)");
  app.add_option("--spin", options.spin_us,
                 "Before each tick, poll the clock for the last US microseconds instead of "
                 "sleeping: ticks are less late, but the processor is busy")
      ->type_name("US")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
}

void define_fault_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Faults");
  add_choice<FaultPolicy>(
      app, "--on-fault", options.on_fault,
      {{"stop", FaultPolicy::Stop}, {"fail", FaultPolicy::Fail}},
      "When a leaf has a fault (it throws, crashes in a separate process, returns an invalid "
      "status): stop the run, or count the fault as Failure");
  app.add_option("--halt-limit", options.load.plugins.halt_limit,
                 "Report a leaf that does not return from halt within S seconds, and end a process "
                 "plugin that does not answer it; 0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  app.add_option(
         "--condition-wait", options.load.plugins.condition_wait,
         "On the wall clock, wait S seconds in each tick for conditions of process plugins; then "
         "they keep their last result (default: a fifth of the period, at most 0.002)")
      ->type_name("S")
      ->check(number_between(0.0, 10.0));
  app.add_option("--condition-age", options.load.plugins.condition_age,
                 "The longest age of that result: after S seconds the condition is Running, with a "
                 "warning (default: 5 periods)")
      ->type_name("S")
      ->check(number_between(0.0, 1e6));
}

void define_assumption_options(CLI::App& app, RunCommandOptions& options) {
  app.add_option("--watch-leaves", options.watched_leaves,
                 "A leaf model: a leaf that does what it does not allow has a fault, which "
                 "--on-fault handles; see `lockstep docs verify`")
      ->type_name("FILE")
      ->excludes(
          app.add_option("--require-ticket", options.ticket,
                         "Run only the tree that this ticket of `lockstep verify --ticket` is "
                         "for, and watch its leaves with the leaf model of the proof")
              ->type_name("FILE"));
  app.add_option("--trusted", options.trusted_keys,
                 "The ticket must be signed with one of these public keys of Ed25519, in PEM")
      ->type_name("FILE")
      ->needs("--require-ticket");
}

void define_property_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Properties");
  add_property_options(app, options.properties);
  add_choice<bool>(
      app, "--on-violation", options.ends_on_violation, {{"warn", false}, {"end", true}},
      "When the run violates a property: warn, or also end the run, with exit code 10");
  define_assumption_options(app, options);
}

void define_monitor_options(CLI::App& app, RunCommandOptions& options) {
  app.add_option("--monitor", options.monitor,
                 "Show the run in a browser (default: 127.0.0.1 and a free port); the link is on "
                 "stderr")
      ->type_name("[ADDRESS:PORT]");
  app.add_option("--monitor-socket", options.monitor_socket,
                 "Without --monitor: make a socket through which `lockstep monitor --attach` opens "
                 "one while the run continues")
      ->type_name("PATH");
  app.add_flag(
      "--monitor-control", options.monitor_control,
      "Allow users of the link to pause the run, tick it step by step, halt it and set entries");
  app.add_flag("--monitor-paused", options.begins_paused,
               "With --monitor-control: pause before the first tick");
  app.add_flag("--monitor-open", options.opens_browser, "Open the page of the run in the browser");
  app.add_option("--monitor-linger", options.monitor_linger,
                 "After the end, serve the page as long as it is open in a browser, at most S "
                 "seconds; a signal ends it (default: 600 on a terminal, otherwise 0)")
      ->type_name("S")
      ->check(number_between(0.0, 1e6));
}

void define_groot_options(CLI::App& app, RunCommandOptions& options) {
  app.add_option("--groot2", options.groot2,
                 "Show the run in Groot2 (default: 127.0.0.1:1667; it also takes the next port)")
      ->type_name("[ADDRESS:PORT]");
  app.add_flag(
      "--groot2-control", options.groot2_control,
      "Allow every user who reaches that address to pause the run with the breakpoints of Groot2");
}

void define_rotation_options(CLI::App& app, RunCommandOptions& options) {
  app.add_option_function<std::string>(
         "--record-rotate",
         [&options](const std::string& text) {
           const std::uint64_t keep = options.rotation.keep;
           options.rotation = *rotation_from(text);
           options.rotation.keep = keep;
         },
         "Begin another file after this size or time: 500MB, 2GiB, 30min, 8h. FILE.jsonl becomes "
         "FILE.0001.jsonl, FILE.0002.jsonl, …")
      ->type_name("SIZE|TIME")
      ->check([](const std::string& text) {
        return rotation_from(text)
                   ? std::string()
                   : "expected a size from 1kB on (kB, MB, GB, KiB, MiB, GiB) or a time from 0.1s "
                     "on (s, min, h), as 500MB or 30min";
      })
      ->needs("--record");
  app.add_option("--record-keep", options.rotation.keep,
                 "With --record-rotate: keep only the last N files (default: all)")
      ->type_name("N")
      ->transform(whole_number(1))
      ->needs("--record-rotate");
}

void define_record_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Recording");
  app.add_option(
         "--record", options.record,
         "Write a recording (JSON Lines; see `lockstep docs recording`); FILE.jsonl.zst compresses "
         "it, FILE.mcap is for Foxglove and PlotJuggler")
      ->type_name("FILE.jsonl");
  app.add_flag("--record-compress", options.record_compress,
               "Compress the recording with zstd, whatever its name")
      ->needs("--record");
  define_rotation_options(app, options);
  app.add_option("--record-entries", options.record_entries,
                 "Blackboard entries in the recording: all, none, or KEY,KEY,… (of a value longer "
                 "than 256 bytes, only the change is recorded)")
      ->type_name("KEYS")
      ->capture_default_str();
  add_choice<bool>(app, "--on-record-error", options.stop_on_record_error,
                   {{"stop", true}, {"go-on", false}},
                   "When the recording cannot be written any more, such as on a full disk: stop "
                   "the run, or continue without it");
}

void define_checkpoint_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Resume after a cut");
  app.add_option("--checkpoint", options.keep.file,
                 "Keep the state of the run in FILE, so that --resume can continue it; see "
                 "`lockstep docs resume`")
      ->type_name("FILE");
  app.add_flag("--resume", options.keep.resumes,
               "Continue the run of --checkpoint that a kill, a crash or a power cut ended; if "
               "there is none, start a new run")
      ->needs("--checkpoint");
  add_choice<AfterCut>(app, "--on-resume", options.keep.on_resume,
                       {{"restart", AfterCut::StartsAgain},
                        {"failure", AfterCut::Failure},
                        {"success", AfterCut::Success}},
                       "With --resume: leaves that ran at the cut and cannot continue start again, "
                       "or count as Failure or as Success in their next tick");
  app.add_option("--resume-limit", options.keep.resume_limit,
                 "End with exit code 5 instead of resuming more often than N times in a row "
                 "without a leaf that completes")
      ->type_name("N")
      ->transform(whole_number(1, 1'000'000))
      ->capture_default_str();
  app.add_flag("--checkpoint-required", options.checkpoint_required,
               "End the run with exit code 8 if its state cannot be kept any more, as on a full "
               "disk, and do not start one that cannot be kept")
      ->needs("--checkpoint");
  app.add_option("--checkpoint-sync", options.checkpoint_sync_ms,
                 "Write the checkpoint through to the disk at most each MS milliseconds")
      ->type_name("MS")
      ->check(number_between(1.0, 1e6))
      ->capture_default_str();
}

void define_view_options(CLI::App& app, RunCommandOptions& options) {
  begin_group(app, "Watching");
  app.add_option("--break", options.breaks,
                 "Pause at this node and read commands from stdin; WHEN is before (the "
                 "default), after, success, failure or barrier; may be repeated")
      ->type_name("NODE[:WHEN]")
      ->allow_extra_args(false);
  app.add_option("--break-if", options.break_conditions,
                 "Pause after the tick in which this becomes true, such as 'left.progress > 0.4 "
                 "and not right.held', and read commands from stdin; may be repeated. See "
                 "`lockstep docs properties`")
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  app.add_option("--attended", options.attended,
                 "Pause a run that is unattended for S seconds: `lockstep attend`, the switch of "
                 "the page, or a command at the prompt")
      ->type_name("S")
      ->check(number_between(0.1, 1e6));
  app.add_option("--view", options.view,
                 "On stderr while it runs: live (a terminal), plain lines, none; auto = live on a "
                 "terminal, otherwise plain")
      ->check(one_of({"auto", "live", "plain", "none"}))
      ->capture_default_str();
  add_choice<lockstep_log_level>(
      app, "--log-level", options.log_level,
      {{"debug", LOCKSTEP_LOG_DEBUG},
       {"info", LOCKSTEP_LOG_INFO},
       {"warning", LOCKSTEP_LOG_WARNING},
       {"none", kNoLogs}},
      "Show log lines of leaves on stderr, in any view: this level and more urgent ones");
  app.add_flag("--json", options.json, "Print the summary as JSON");
  define_monitor_options(app, options);
  define_groot_options(app, options);
  app.add_flag("--notify", options.notifies,
               "Notify systemd that the run has begun, that it continues (WatchdogSec=), and that "
               "it ends: for a service with Type=notify");
}

void define_team_options(CLI::App& app, TeamNetworkOptions& options) {
  app.add_option("--team-domain", options.domain,
                 "Robots of a team hear only those with the same number: the domain of DDS")
      ->transform(whole_number(0, 230))
      ->capture_default_str();
  app.add_option(
      "--team-peer", options.peers,
      "The address of another robot of the team, where multicast does not find it; may be "
      "repeated");
  app.add_option("--team-interface", options.interface,
                 "The network interface to the team (default: the system chooses)")
      ->type_name("NAME");
}

// What one expert needs, or needs once.
constexpr const char* kOfExperts[] = {"--ros-package",
                                      "--hang-limit",
                                      "--mock-output",
                                      "--attended",
                                      "--leaves",
                                      "--stall-fail",
                                      "--overrun",
                                      "--tick",
                                      "--tick-budget",
                                      "--time-calls",
                                      "--realtime",
                                      "--priority",
                                      "--cpu",
                                      "--helper-cpu",
                                      "--spin",
                                      "--halt-limit",
                                      "--condition-wait",
                                      "--condition-age",
                                      "--property-file",
                                      "--watch-leaves",
                                      "--require-ticket",
                                      "--trusted",
                                      "--record-compress",
                                      "--record-rotate",
                                      "--record-keep",
                                      "--record-entries",
                                      "--on-record-error",
                                      "--checkpoint",
                                      "--resume",
                                      "--on-resume",
                                      "--resume-limit",
                                      "--checkpoint-sync",
                                      "--checkpoint-required",
                                      "--break-if",
                                      "--monitor-socket",
                                      "--monitor-paused",
                                      "--monitor-open",
                                      "--monitor-linger",
                                      "--groot2-control",
                                      "--notify",
                                      "--team-domain",
                                      "--team-peer",
                                      "--team-interface"};

}  // namespace

std::optional<Nanoseconds> RunCommandOptions::tick_budget() const {
  if (!is_real()) return std::nullopt;
  if (!tick_budget_ms) return std::max(deadline_of(1, rate), kLeastAlarmed);
  if (*tick_budget_ms == 0) return std::nullopt;
  return from_seconds(*tick_budget_ms / 1e3);
}

// The thread that looks at ticks needs a processor at the right time.
bool RunCommandOptions::times_each_call() const {
  const auto budget = tick_budget();
  return budget && (times_calls || *budget < kLeastAlarmed || realtime.realtime ||
                    Processors::allowed().count() < 2);
}

std::optional<Nanoseconds> RunCommandOptions::end_limit() const {
  if (load.plugins.halt_limit == 0) return std::nullopt;
  return from_seconds(load.plugins.halt_limit);
}

KeepOptions RunCommandOptions::kept() const {
  KeepOptions options = keep;
  options.sync = from_seconds(checkpoint_sync_ms / 1e3);
  options.real_time = is_real();
  return options;
}

LoopOptions RunCommandOptions::loop() const {
  LoopOptions loop{.rate = rate,
                   .max_ticks = max_ticks,
                   .timeout = std::nullopt,
                   .stop_signal = StopSignals::received,
                   .overrun = overrun,
                   .spin = from_seconds(spin_us / 1e6),
                   .cuts = cuts};
  if (timeout) loop.timeout = from_seconds(*timeout);
  // A tree that never completes would fill a disk with its recording in minutes.
  if (!is_real() && !timeout && !max_ticks) loop.max_ticks = kMostVirtualTicks;
  return loop;
}

void define_run_options(CLI::App& app, RunCommandOptions& options) {
  add_tree_argument(app, options.tree, "Tree file; - is stdin");
  begin_group(app, "The tree and its leaves");
  add_load_options(app, options.load);
  options.load.plugins.run_programs = true;
  add_leaves_option(app, options.leaves);
  add_mock_options(app, options.load);
  define_loop_options(app, options);
  define_time_options(app, options);
  define_fault_options(app, options);
  define_property_options(app, options);
  define_record_options(app, options);
  define_checkpoint_options(app, options);
  define_view_options(app, options);
  define_team_options(app, options.team);
  only_in_help_all(app, kOfExperts);
}

}  // namespace lockstep::host
