#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/system/freed_memory.h"
#include "base/system/own_thread.h"
#include "base/terminal/fitted.h"
#include "base/terminal/outlet.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/given_leaves.h"
#include "cli/load/real_time_leaves.h"
#include "cli/outputs.h"
#include "cli/run/assumed_leaves.h"
#include "cli/run/connected_team.h"
#include "cli/run/keep.h"
#include "cli/run/mcap_recording.h"
#include "cli/run/progress_notes.h"
#include "cli/run/required_ticket.h"
#include "cli/run/run_options.h"
#include "cli/run/run_watch.h"
#include "cli/run/service_notice.h"
#include "cli/run/view.h"
#include "cli/run/watchers.h"
#include "judge/measure/property_steps.h"
#include "judge/summary/property_observer.h"
#include "judge/summary/repeated_halts.h"
#include "judge/summary/standstills.h"
#include "judge/summary/statistics.h"
#include "leaves/plugin/contract/plugin_clock.h"
#include "record/part_names.h"
#include "record/write/recorder.h"
#include "record/write/same_entries.h"
#include "run/crash_report.h"
#include "run/cut_text.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "run/stall_fail.h"
#include "run/stop_signals.h"
#include "show/view/line_budget.h"
#include "verify/check/advice.h"

namespace lockstep::host {
namespace {

int exit_code_of(const RunEnd& end) {
  switch (end.reason) {
    case StopReason::Completed:
      return end.status == Status::Success ? kExitSuccess : kExitFailure;
    case StopReason::Fault:
      return kExitLeafFault;
    case StopReason::Timeout:
    case StopReason::MaxTicks:
      return kExitLimit;
    case StopReason::Signal:
      return kExitSignal + end.signal;
    case StopReason::Overrun:
      return kExitOverrun;
    case StopReason::Recording:
      return kExitRecording;
    case StopReason::Property:
      return kExitProperty;
    case StopReason::Stopped:  // of a program only
      break;
  }
  return kExitLeafFault;
}

// Says which leaf was at fault, and when.
std::string describe(const Fault& fault, const Shape& shape, const RunEnd& end) {
  const bool in_tick = !fault.in_last_halt && end.has_ticked();
  return fmt::format("{} {}{}: {}", describe_node(shape, fault.node),
                     failure_text(fault, end.ticks, end.first_tick),
                     in_tick ? fmt::format(" at {:.3f} s", to_seconds(end.last)) : "",
                     fault.message);
}

// None: all.
std::optional<std::vector<std::string>> recorded_keys(const RunCommandOptions& options) {
  if (options.record_entries == "all") return std::nullopt;
  std::vector<std::string> keys;
  if (options.record_entries == "none") return keys;
  std::istringstream text(options.record_entries);
  for (std::string key; std::getline(text, key, ',');) keys.push_back(key);
  return keys;
}

bool knows_recorded_keys(const RunCommandOptions& options, const Tree& tree) {
  std::vector<std::string_view> known;
  for (const Slot& slot : tree.slots) known.emplace_back(slot.name);
  for (const std::string& key : recorded_keys(options).value_or(std::vector<std::string>())) {
    if (std::ranges::find(known, key) != known.end()) continue;
    const std::string near = did_you_mean(key, known);
    print_error(fmt::format("--record-entries: the tree has no entry '{}'", printable(key)),
                near.empty() ? "its entries: " + (known.empty() ? "none" : listed(known)) : near);
    return false;
  }
  return true;
}

// Nothing: one is wrong, which is reported.
std::optional<PausePlaces> pause_places_of(const RunCommandOptions& options, const Tree& tree) {
  PausePlaces places;
  if (options.breaks.empty() && options.break_conditions.empty()) return places;
  if (options.tree == "-") {
    print_error("--break reads commands from stdin, which has the tree");
    return std::nullopt;
  }
  const Shape shape = shape_of(tree);
  for (const std::string& text : options.breaks) {
    const auto breakpoint = parse_breakpoint(text, shape);
    if (!breakpoint) {
      print_error("--break: " + printable(breakpoint.error().message), breakpoint.error().hint);
      return std::nullopt;
    }
    places.breakpoints.push_back(*breakpoint);
  }
  const PropertyNames names =
      options.break_conditions.empty() ? PropertyNames() : property_names(shape);
  for (const std::string& text : options.break_conditions) {
    auto condition = parse_break_condition(text, names);
    if (!condition) {
      const PropertyError& error = condition.error();
      Diagnostics diagnostics;
      diagnostics.error("bad-property"_code,
                        {"--break-if", 1, static_cast<std::uint32_t>(error.offset) + 1},
                        error.message, error.hint, {.text = text, .column = 1});
      print_diagnostics(diagnostics, Severity::Error);
      return std::nullopt;
    }
    places.conditions.push_back(std::move(*condition));
  }
  return places;
}

// Whether this terminal takes commands or answers. A person who types reads lines, so there is no
// live view.
bool has_prompt(const RunCommandOptions& options, const PausePlaces& places, const Shape& shape) {
  return !places.empty() || has_typist(options, shape);
}

// There is one, and its members end in the order in which they may.
class RunCommand {  // NOLINT(clang-analyzer-optin.performance.Padding)
 public:
  RunCommand(const RunCommandOptions& options, const Runnable& runnable,
             std::vector<Property> properties, WatcherSockets sockets, const PausePlaces& places,
             std::unique_ptr<KeptRun> kept, WatchedLeaves* leaves)
      : options_(options),
        tree_(runnable.tree),
        kept_(std::move(kept)),
        watched_leaves_(leaves),
        shape_(shape_of(tree_)),
        end_budget_(options.end_limit()),
        view_(
            options.view != "none" && has_prompt(options, places, shape_) ? "plain" : options.view,
            shape_, options.log_level),
        watch_(shape_, options,
               [this](const std::string& line) { view_.print("warning: " + line); }),
        statistics_(shape_),
        repeated_halts_(shape_,
                        [this](NodeIndex node, const std::string& text) {
                          if (!repeated_halts_budget_.take(monotonic_now())) return;
                          log(shape_.nodes[node].path, text);
                          view_.print("warning: " + text);
                        }),
        description_(describe_run(runnable)),
        watchers_(
            shape_, options, description_, std::move(sockets), places,
            [this](const std::string& line) { view_.print(line); },
            [this](const std::string& line) {
              log("run", line);
              view_.print(line);
            }) {
    if (!options.record.empty()) {
      recorder_.emplace(shape_, recorder_options());
    }
    if (options.notifies) service_.emplace();
    if (options.stall > 0 || options.stall_fail > 0) watch_standstills();
    if (!properties.empty()) watch_properties(std::move(properties));
  }

  // Runs the tree to its end; initializes `plugins` before and deinitializes them after.
  int run(std::shared_ptr<PluginSet>& plugins) {
    if (recorder_ && !recorder_->error().empty()) {
      print_error(recorder_->error());
      const int signal = StopSignals::received();  // while no reader has opened a pipe
      return signal == 0 ? kExitUsage : kExitSignal + signal;
    }
    watchers_.tell();
    Diagnostics refused;
    // A plugin whose leaves are played is not asked to begin.
    if (options_.leaves.empty() && !plugins->initialize(refused)) {
      view_.close();
      print_diagnostics(refused, Severity::Warning);
      return kExitPluginRefused;
    }
    if (options_.has_plugin_clock() && !open_clock(*plugins)) return kExitUsage;
    const auto end = run_tree();
    const int code = end ? first_failure(code_of(*end), print_summary()) : kExitUsage;
    plugins.reset();
    watchers_.linger();
    return code;
  }

 private:
  // Nothing when the system refuses what the user asks of it.
  std::optional<RunEnd> run_tree() {
    WallClock wall_clock;
    VirtualClock virtual_clock;
    Clock& clock = plugin_clock_        ? static_cast<Clock&>(*plugin_clock_)
                   : options_.is_real() ? static_cast<Clock&>(wall_clock)
                                        : virtual_clock;
    if (plugin_clock_) wait_for_time();
    if (!connect_team()) return std::nullopt;
    RunEnd end;
    std::vector<Fault> in_last_halt;
    {
      Run run(tree_, run_options());
      if (!make_realtime() || (kept_ && !begin_to_keep(run))) return std::nullopt;
      end = run_loop(run, clock, loop_options(), observers());
      if (kept_) kept_->end(end.ticks, end.last);
      if (end.fault) in_last_halt = run.ticker().take_tolerated();
    }
    view_.close();
    if (end.fault) print_error(describe(*end.fault, shape_, end));
    for (const Fault& fault : in_last_halt) print_error(describe(fault, shape_, end));
    return end;
  }

  // Before its leaves are made.
  bool connect_team() {
    auto team = ConnectedTeam::open(options_, tree_, team_run_, [this](const std::string& line) {
      log("team", line);
      view_.print("warning: " + line);
    });
    if (!team) {
      view_.close();
      print_error(team.error().message, team.error().hint);
      return false;
    }
    team_ = std::move(*team);
    if (team_ != nullptr) team_->run().use_here();
    if (team_ != nullptr && kept_) kept_->set_team(team_->run());
    return true;
  }

  bool begin_to_keep(Run& run) {
    if (properties_) kept_->set_properties(properties_->checks());
    if (kept_->continues()) {  // what leaves log while they are restored is of then
      statistics_.join();
      view_.continue_with(kept_->before().ticks, kept_->before().time);
    }
    const auto why_not = kept_->begin(run, [this](const std::string& error) {
      view_.print("error: nothing is kept any more: " + error);
    });
    if (why_not) {
      view_.close();
      print_error("--checkpoint: " + why_not->message);
      return false;
    }
    if (!kept_->resumed().empty()) tell(resumed());
    for (const std::string& it : kept_->fresh_properties()) tell(fresh_property_text(it));
    return true;
  }

  std::string resumed() const {
    return kept_->resumed() + (options_.record.empty()
                                   ? ""
                                   : fmt::format("; recorded in '{}'", printable(options_.record)));
  }

  // What happens to the run as a whole.
  void tell(const std::string& text) {
    if (recorder_) recorder_->log("lockstep", "info", text);
    watchers_.log("lockstep", "info", text);
    view_.print(text);
  }

  bool open_clock(const PluginSet& plugins) {
    const lockstep_clock* const clock = plugins.clock(options_.clock);
    if (clock != nullptr) {
      const auto why = plugin_clock_.emplace(*clock).open();
      if (!why) return true;
      print_error(fmt::format("--clock {}: {}", options_.clock, *why));
    } else {
      print_error(fmt::format("--clock {}: no plugin of this process has it", options_.clock),
                  "the plugin ros2 has the clock ros: --plugin ros2, without --isolate");
    }
    view_.close();
    return false;
  }

  // Before the clock has a time, no tick has one.
  void wait_for_time() {
    constexpr Nanoseconds kSilence = std::chrono::seconds(2);
    const Nanoseconds begun = monotonic_now();
    bool is_told = false;
    while (!plugin_clock_->has_time() && StopSignals::received() == 0) {
      if (!is_told && monotonic_now() - begun > kSilence) {
        view_.print(fmt::format("the run begins when --clock {} has a time", options_.clock));
        is_told = true;
      }
      WallClock().sleep_until(monotonic_now() + std::chrono::milliseconds(5));
    }
  }

  // Threads that were started before keep their priority and their processors.
  bool make_realtime() {
    const auto problems = apply_realtime(options_.realtime);
    if (!problems.empty()) view_.close();
    for (const Problem& problem : problems) print_error(problem.message, problem.hint);
    return problems.empty();
  }

  RunOptions run_options() {
    return {.seed = options_.seed,
            .rate = options_.rate,
            .log = leaf_log(),
            .on_fault = options_.on_fault,
            .exactly_once = options_.exactly_once,
            .virtual_time = !options_.is_real(),
            .watch = &watch_.leaves(),
            .end_budget = &end_budget_};
  }

  LeafLog leaf_log() {
    return [this, view = view_.leaf_log()](std::string_view who, lockstep_log_level level,
                                           std::string_view text) {
      if (recorder_) recorder_->log(who, name_of(level), text);
      watchers_.log(who, name_of(level), text);
      view(who, level, text);
    };
  }

  RunDescription describe_run(const Runnable& runnable) const {
    RunDescription run{.tree_file = options_.tree, .rate_hz = options_.rate, .seed = options_.seed};
    run.arguments = values_of(runnable.arguments);
    run.values = runnable.values;
    run.entries = recorded_keys(options_);
    run.exactly_once = options_.exactly_once;
    const bool is_in_team = !teams_of(tree_, from_seconds(1 / options_.rate)).empty();
    if (is_in_team) run.run = TeamRun::short_run(team_run_);
    return run;
  }

  RecorderOptions recorder_options() {
    RecorderOptions recorder{.path = options_.record, .run = description_};
    recorder.run.leaves_out_answers = description_.entries.has_value();
    recorder.compresses = options_.record_compress;
    recorder.rotation = options_.rotation;
    if (options_.record.ends_with(".mcap")) recorder.encoder = mcap_recording(options_.is_real());
    recorder.on_error = [this](const std::string& error) { view_.print("error: " + error); };
    return recorder;
  }

  // A recording or a checkpoint that must be complete, and cannot be written.
  bool lacks_what_is_required() const {
    return (recorder_ && options_.stop_on_record_error && recorder_->failed()) ||
           (kept_ && options_.checkpoint_required && kept_->has_failed());
  }

  // Also what was found in the last tick or at the end.
  int code_of(const RunEnd& end) const {
    const bool is_violated =
        options_.ends_on_violation && properties_ && properties_->is_violated();
    const bool is_limit = end.reason == StopReason::Timeout || end.reason == StopReason::MaxTicks;
    if (end.reason == StopReason::Completed && is_violated) return kExitProperty;
    const bool is_in_order = end.reason == StopReason::Completed || is_limit;
    return is_in_order && lacks_what_is_required() ? kExitRecording : exit_code_of(end);
  }

  // A warning for those who record and watch.
  void log(const std::string& who, const std::string& text) {
    if (recorder_) recorder_->log(who, "warning", text);
    watchers_.log(who, "warning", text);
  }

  void watch_properties(std::vector<Property> properties) {
    properties_.emplace(std::move(properties), [this](const Property& it, const auto& when) {
      const std::string who = it.has_name() ? fmt::format("property {}", it.name()) : "property";
      const std::string text = fmt::format("violated {}: {}", when, it.text());
      log(who, text);
      view_.print(fmt::format("warning: {} is {}", who, text));
    });
  }

  void watch_standstills() {
    std::optional<Nanoseconds> limit;
    if (options_.stall > 0) limit = from_seconds(options_.stall);
    standstills_.emplace(shape_, limit, [this](NodeIndex node, const auto& lines) {
      log(shape_.nodes[node].path, joined(lines, "; "));
      tell_standstill(lines);
    });
    if (options_.stall_fail <= 0) return;
    stall_fail_.emplace(tree_, from_seconds(options_.stall_fail),
                        [this](const Standstill& standstill, NodeIndex failed) {
                          standstills_->failed(standstill, failed);
                        });
  }

  // A Retry may come to stand again and again.
  void tell_standstill(const std::vector<std::string>& lines) {
    if (!standstill_budget_.take(monotonic_now())) return;
    if (const std::uint64_t left_out = standstill_budget_.take_left_out(); left_out > 0) {
      view_.print(fmt::format("... {} left out", counted(left_out, "standstill")));
    }
    std::string_view begin = "warning: ";
    for (const std::string& line : lines) {
      view_.print(fmt::format("{}{}", begin, line));
      begin = "  ";
    }
  }

  LoopOptions loop_options() {
    LoopOptions loop = options_.loop();
    loop.watched_leaves = watched_leaves_;
    if (stall_fail_) loop.stall_fail = &*stall_fail_;
    if (properties_ && options_.ends_on_violation) {
      loop.property_violated = [this] { return properties_->is_violated(); };
    }
    loop.control = watchers_.control();
    loop.cut = [this](std::span<const CutLeaf> cut) { tell(cut_text(cut, tree_)); };
    if (kept_) {
      loop.checkpoints = kept_->writer();
      loop.before = kept_->before();
    }
    if (options_.stop_on_record_error || options_.checkpoint_required)
      loop.writing_failed = [this] { return lacks_what_is_required(); };
    return loop;
  }

  std::span<Observer* const> observers() {
    observers_ = {&statistics_, &repeated_halts_};
    if (team_ != nullptr) observers_.push_back(&team_->run());
    if (standstills_) observers_.push_back(&*standstills_);  // before those that it tells
    if (properties_) observers_.push_back(&*properties_);    // likewise
    if (recorder_) observers_.push_back(&*recorder_);
    watchers_.add_to(observers_);
    if (view_.observer() != nullptr) observers_.push_back(view_.observer());
    observers_.push_back(&watch_);
    if (service_) observers_.push_back(&*service_);
    return observers_;
  }

  int print_summary() {
    Summary summary = statistics_.summary();
    summary.tick_limit = options_.tick_limit;
    if (kept_ && !kept_->resumed().empty()) summary.notes.push_back(resumed());
    if (kept_ && !kept_->error().empty()) summary.notes.push_back(kept_->error());
    if (recorder_ && !recorder_->error().empty()) summary.notes.push_back(recorder_->error());
    if (recorder_ && recorder_->lost() != 0) {
      summary.notes.push_back(fmt::format("the recording lacks {}: the disk was too slow",
                                          counted(recorder_->lost(), "tick")));
    }
    if (standstills_) standstills_->add_to(summary);
    if (properties_) properties_->add_to(summary);
    repeated_halts_.add_to(summary);
    watch_.add_to(summary);
    settle_messages(summary.notes);
    if (std::string late = end_budget_.note(); !late.empty()) summary.notes.push_back(late);
    if (options_.json) return write_results(to_json(summary) + "\n", summary.signal);
    std::string text;
    write_text(summary, text, wants_color(results_file()));
    return write_results(fitted(text, results_width()), summary.signal);
  }

  // The last of those that the end of a run waits for.
  void settle_messages(std::vector<std::string>& notes) {
    const Nanoseconds patience =
        std::min<Nanoseconds>(Outlet::kPatience, end_budget_.rest().value_or(Outlet::kPatience));
    const Nanoseconds began = monotonic_now();
    std::string lost = lost_messages(patience);
    if (lost.empty()) return;
    if (monotonic_now() - began >= patience) end_budget_.used_up_by("who reads stderr");
    notes.push_back(std::move(lost));
  }

  const RunCommandOptions& options_;
  const Tree& tree_;
  const std::unique_ptr<KeptRun> kept_;  // null: it is not kept
  WatchedLeaves* const watched_leaves_;  // null: nothing is assumed of leaves
  const Shape shape_;
  EndBudget end_budget_;
  std::optional<PluginClock> plugin_clock_;  // none: a clock of lockstep
  View view_;
  RunWatch watch_;
  Statistics statistics_;
  LineBudget repeated_halts_budget_{ConsolePlain::kBurstOfFaults};
  RepeatedHalts repeated_halts_;
  const std::uint64_t team_run_ = ConnectedTeam::random_run();
  const RunDescription description_;
  std::optional<Recorder> recorder_;
  Watchers watchers_;
  std::optional<Standstills> standstills_;
  std::optional<PropertyObserver> properties_;
  std::optional<StallFail> stall_fail_;
  std::optional<ServiceNotice> service_;
  std::unique_ptr<ConnectedTeam> team_;  // null: the tree is in none
  LineBudget standstill_budget_{ConsolePlain::kBurstOfFaults};
  std::vector<Observer*> observers_;
};

void last_words() {
  AppendFile::emergency_flush();
  View::last_words();
}

// The files that a recording must not overwrite.
std::vector<NamedFile> inputs_of_run(const RunCommandOptions& options, const Loaded& loaded) {
  std::vector<std::string> given{options.tree, options.leaves, options.watched_leaves,
                                 options.ticket, options.trusted_keys};
  given.insert(given.end(), options.properties.files.begin(), options.properties.files.end());
  std::vector<NamedFile> inputs = inputs_of(loaded, std::move(given));
  // A text of the tree may name a file that a leaf reads.
  for (const Value& value : loaded.definition.values) {
    const auto* text = std::get_if<std::string>(&value);
    if (text != nullptr && !text->empty()) inputs.push_back({*text, *text});
  }
  return inputs;
}

// Before the first of lockstep's threads starts.
bool place_helpers(const RunCommandOptions& options) {
  if (!options.helper_processors) return true;
  const auto refusal = options.helper_processors->refusal();
  if (refusal) print_error("--helper-cpu: " + refusal->message, refusal->hint);
  keep_own_threads_on(options.helper_processors);
  return !refusal;
}

// Where the command line says nothing.
void take_what_is_said(const GivenLeaves& leaves, RunCommandOptions& options) {
  options.load.unknown = MissingNodes::AreMocked;
  if (leaves.rate() && !options.is_rate_given) {
    options.rate = *leaves.rate();
    options.is_rate_given = true;
  }
  options.cuts = leaves.cuts();
  if (options.max_ticks || options.timeout || !leaves.ticks()) return;
  options.max_ticks = leaves.ticks();
  options.tick_limit = "@ticks of " + options.leaves;
}

// The chunks of an MCAP file are compressed.
bool is_compressed_twice(const RunCommandOptions& options) {
  const bool is_mcap = options.record.ends_with(".mcap");
  if (!options.record.ends_with(".mcap.zst") && !(is_mcap && options.record_compress)) return false;
  print_error("--record: an MCAP file is compressed inside", "name it FILE.mcap, and nothing more");
  return true;
}

// The files that a recording replaces.
std::vector<std::string> replaced_files(const RunCommandOptions& options) {
  std::vector<std::string> files;
  if (!options.record.empty()) files.push_back(options.record);
  if (options.rotation.is_wanted()) {
    for (std::string& it : parts_that_exist(options.record)) files.push_back(std::move(it));
  }
  return files;
}

bool would_replace(const RunCommandOptions& options, std::span<const NamedFile> used) {
  if (!options.keep.file.empty() && would_overwrite("--checkpoint", options.keep.file, used)) {
    return true;
  }
  return std::ranges::any_of(replaced_files(options), [&](const std::string& file) {
    return would_overwrite("--record", file, used);
  });
}

bool can_rotate(const RunCommandOptions& options) {
  std::error_code none;
  const bool is_special = std::filesystem::exists(options.record, none) &&
                          !std::filesystem::is_regular_file(options.record, none);
  if (!options.rotation.is_wanted() || !is_special) return true;
  print_error(fmt::format("--record-rotate: '{}' is not a file", printable(options.record)));
  return false;
}

bool is_checkpoint_recorded(const RunCommandOptions& options) {
  if (options.keep.file.empty() || options.keep.file != options.record) return false;
  print_error("--checkpoint and --record name the same file");
  return true;
}

int run(RunCommandOptions options) {
  if (is_compressed_twice(options) || is_checkpoint_recorded(options)) return kExitUsage;
  // First, while /dev/stdout still is what the user means by it.
  if (would_replace(options, standard_outputs()) || !can_rotate(options)) return kExitUsage;
  keep_stdout_for_results();
  CrashReport::set_last_words(last_words);
  GivenLeaves leaves;  // to which the tree refers
  if (!options.leaves.empty()) {
    if (!leaves.read(options.leaves)) return kExitUsage;
    take_what_is_said(leaves, options);
  }
  Diagnostics diagnostics;
  auto loaded = load_given(options.tree, options.load, diagnostics);
  if (loaded) add_advice_of_run(*loaded->project, loaded->definition, diagnostics);
  print_diagnostics(diagnostics, Severity::Warning);
  if (!loaded) return exit_code_of(loaded.error());
  if (!options.ticket.empty()) {
    if (const int refused = require_ticket(options, *loaded); refused != kExitSuccess)
      return refused;
  }
  AssumedLeaves assumed;
  if (!assumed.read(options)) return kExitInvalidTree;
  // Until here a signal ends the program as it ends any other: there is nothing to halt or to save.
  StopSignals::install(last_words);
  if (!place_helpers(options)) return kExitUsage;
  const Outlet::Thread messages_thread(messages());
  if (would_replace(options, inputs_of_run(options, *loaded))) return kExitUsage;
  if (const auto refusal = options.notifies ? ServiceNotice::refusal() : std::nullopt) {
    print_error("--notify: " + refusal->message, refusal->hint);
    return kExitUsage;
  }
  auto sockets = listen_for_watchers(options, loaded->definition);
  if (!sockets) return refuse(sockets.error());
  if (!options.leaves.empty()) leaves.take_over(loaded->definition);
  TreeIdentity identity;
  if (!options.keep.file.empty()) identity = identity_of_run(options, *loaded);
  Runnable runnable = make_runnable(std::move(*loaded));
  return_freed_memory();
  if (!options.leaves.empty() && !leaves.give(runnable.tree)) return kExitUsage;
  if (!knows_recorded_keys(options, runnable.tree)) return kExitUsage;
  auto properties = all_properties(std::move(runnable.properties), options.properties,
                                   [&] { return property_names(shape_of(runnable.tree)); });
  if (!properties) return kExitUsage;
  if (!assumed.watch(runnable.tree, *properties)) return kExitInvalidTree;
  const auto places = pause_places_of(options, runnable.tree);
  if (!places) return kExitUsage;
  auto kept = keep(options, std::move(identity), runnable.tree);
  if (!kept) return kept.error();
  if (*kept != nullptr && (*kept)->continues() && !options.record.empty()) {
    options.rotation.before = files_that_exist(options.record);
    const auto same = check_same_entries(options.rotation.before, shape_of(runnable.tree),
                                         recorded_keys(options));
    if (!same) {
      print_error(printable(same.error().message), same.error().hint);
      return kExitUsage;
    }
    options.record = name_of_resumed(options.record);
  }
  Diagnostics notes;
  note_leaves_without_progress(runnable.tree, options.tree, notes);
  if (!options.is_real()) {
    warn_of_real_time_leaves(runnable.tree, options.tree, "the run means little; use --clock wall",
                             notes);
  }
  print_diagnostics(notes, Severity::Note);
  if (options.view == "live" && has_prompt(options, *places, shape_of(runnable.tree)))
    print_note("--view live: the view is plain, since you can type in this terminal");
  return RunCommand(options, runnable, std::move(*properties), std::move(*sockets), *places,
                    std::move(*kept), assumed.watched())
      .run(runnable.plugins);
}

std::function<int()> define_run(CLI::App& app) {
  const auto options = std::make_shared<RunCommandOptions>();
  define_run_options(app, *options);
  return [options] { return run(*options); };
}

}  // namespace

extern const Command kRunCommand{
    "run", "Run a tree at a fixed rate until it completes",
    "The summary goes to stdout, everything else to stderr.\n"
    "Exit code: 0 Success, 1 Failure, 2 usage, 3 invalid tree, 4 plugin refused, 5 leaf fault,\n"
    "6 a plugin crashed or hung, 7 --overrun fail, 8 --on-record-error stop, 9 lockstep failed,\n"
    "10 --on-violation end, 124 --timeout or --max-ticks, 128 + N signal N, as 130 for SIGINT "
    "(running leaves are halted in\n"
    "order; a second one ends the program at once), 141 the reader of stdout has gone.\n"
    "\n"
    "Examples:\n"
    "  lockstep run --example door_pulling\n"
    "  lockstep run --example door_pulling --arg barriers=0.5 --record run.jsonl\n"
    "  lockstep run --example door_pulling --clock virtual --seed 7 --json\n"
    "  lockstep run --example door_pulling --monitor 8080 --groot2 1667\n"
    "  lockstep run --example door_pulling --property 'base.held at most 200 ticks'\n"
    "  lockstep run --example door_pulling --realtime --cpu 1 --spin 50",
    define_run};

}  // namespace lockstep::host
