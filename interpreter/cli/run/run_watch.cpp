#include "cli/run/run_watch.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "judge/summary/statistics.h"
#include "trace/progress_text.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMuchMemory = 64u << 20;  // bytes; a run needs far less

// The memory of this process, in bytes; 0 when the system does not tell.
std::size_t resident_memory() {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  unsigned long all = 0, resident = 0;
  const bool good = std::fscanf(file, "%lu %lu", &all, &resident) == 2;
  std::fclose(file);
  return good ? resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

double milliseconds(Nanoseconds time) {
  return to_seconds(time) * 1e3;
}

}  // namespace

RunWatch::RunWatch(const Shape& shape, const RunCommandOptions& options,
                   std::function<void(const std::string& line)> print)
    : shape_(shape),
      options_(options),
      print_(std::move(print)),
      leaves_(leaf_watch_options()),
      watchdog_(watchdog_options()) {
  pthread_sigmask(SIG_SETMASK, nullptr, &signal_mask_);
}

LeafWatchOptions RunWatch::leaf_watch_options() {
  const auto budget = options_.tick_budget();
  constexpr int kShare = 10;  // of the budget: how exactly a call is timed that lasts
  if (budget && !options_.times_each_call()) {
    alarm_.emplace(*budget / kShare, deadline_of(1, options_.rate));
  }
  LeafWatchOptions watch{.budget = budget,
                         .clock = nullptr,
                         .alarm = alarm_ ? &*alarm_ : nullptr,
                         .looks_after_each_call = false,
                         .on_slow = {},
                         .on_carried = {},
                         .on_float_mode = {}};
  watch.on_slow = [this](NodeIndex leaf, PluginFunction function, Nanoseconds took) {
    print_(fmt::format("{} {}", describe_node(shape_, leaf),
                       over_budget_text(function, took, *options_.tick_budget())));
  };
  watch.on_carried = [this](NodeIndex leaf, Nanoseconds took) {
    has_carried_ = true;
    print_(fmt::format(
        "the values of the ports of {} took {:.3f} ms between processes, more than "
        "the budget of {:.3f} ms",
        describe_node(shape_, leaf), milliseconds(took), milliseconds(*options_.tick_budget())));
  };
  watch.on_float_mode = [this](std::optional<NodeIndex> leaf, PluginFunction function) {
    print_(leaf ? fmt::format("{} changed the floating-point mode in {}; it was restored",
                              describe_node(shape_, *leaf), name_of(function))
                : "a leaf changed the floating-point mode in this tick; it was restored after the "
                  "tick, and if a leaf does so again it is named");
  };
  return watch;
}

WatchdogOptions RunWatch::watchdog_options() {
  // Hangs are watched since plugins were loaded.
  WatchdogOptions watchdog{.hang_limit = Nanoseconds(0),
                           .halt_limit = from_seconds(options_.load.plugins.halt_limit),
                           .alarm = alarm_ ? &*alarm_ : nullptr};
  watchdog.on_long_halt = [this](const CallMark::Look& call, Nanoseconds lasts) {
    print_(fmt::format("the {} {} has not returned from halt for {:.1f} s", call.site->origin->kind,
                       call.site->text(), to_seconds(lasts)));
  };
  return watchdog;
}

void RunWatch::run_started(const Moment&, const RunStart&) {
  memory_at_start_ = resident_memory();
}

void RunWatch::after_tick(const Moment& moment, const TickReport&) {
  constexpr std::size_t kMostLeaves = 20;
  const auto all = moment.live->out_of_range();
  for (; out_of_range_ < std::min(all.size(), kMostLeaves); ++out_of_range_) {
    const OutOfRange& it = all[out_of_range_];
    print_(fmt::format("{} {}", describe_node(shape_, it.node), out_of_range_text(it.reported)));
  }
  const auto went_on = moment.live->went_on();
  for (; went_on_ < std::min(went_on.size(), kMostLeaves); ++went_on_) {
    const WentOn& it = went_on[went_on_];
    print_(fmt::format("{} {}", describe_node(shape_, it.node), went_on_text(it.from, it.to)));
  }
}

void RunWatch::run_ended(const Moment&, const RunEnd&) {
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, &signal_mask_, &now);
  for (int number = 1; number < NSIG; ++number) {
    if (sigismember(&now, number) == sigismember(&signal_mask_, number)) continue;
    notes_.emplace_back("a leaf changed the signal mask of the tick thread");
    break;
  }
  const std::size_t memory = resident_memory();
  if (memory > memory_at_start_ + kMuchMemory) {
    notes_.push_back(fmt::format("memory grew by {} MiB during the run: {}",
                                 (memory - memory_at_start_) >> 20,
                                 has_carried_ ? "large values between processes need some of it"
                                              : "a plugin may leak; --isolate shows which"));
  }
}

void RunWatch::add_to(Summary& summary) const {
  if (const auto budget = options_.tick_budget()) summary.tick_budget = to_seconds(*budget);
  for (const LeafWatch::Timing& timing : leaves_.over_budget()) {
    summary.over_budget.push_back({.path = shape_.nodes[timing.leaf].path,
                                   .is_sampled = timing.is_sampled,
                                   .calls = timing.ticks,
                                   .over_budget = timing.over_budget,
                                   .p50 = to_seconds(timing.p50),
                                   .p99 = to_seconds(timing.p99),
                                   .max = to_seconds(timing.max)});
  }
  summary.notes.insert(summary.notes.end(), notes_.begin(), notes_.end());
}

}  // namespace lockstep::host
