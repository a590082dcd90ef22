// The summary of a run: plain data, which statistics.h fills in, and its output as text and as
// JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/json/json.h"
#include "judge/measure/hindrance.h"
#include "judge/measure/synchronized_measure.h"
#include "judge/summary/why.h"
#include "language/property/property.h"
#include "trace/observer.h"

namespace lockstep::host {

// "success", "failure", "stopped", "fault" or "skipped".
std::string_view to_string(RunResult result);
Style style_of(RunResult result);
// "completed", "fault", "timeout", "max_ticks", "signal", "overrun" or "recording", as recordings
// and JSON spell it.
std::string_view to_string(StopReason reason);

// "success (completed)", or "fault" alone.
std::string ending(std::string_view result, std::string_view reason);

struct ChildSummary {
  std::string name;
  double held_seconds = 0;
  std::uint64_t held_ticks = 0;
  std::uint64_t waits = 0;
};

struct SynchronizedSummary {
  std::string path, kind;
  std::uint64_t samples = 0;  // ticks of the node
  double distance_sum = 0, distance_mean = 0;
  double largest_spread = 0;
  std::optional<double> spread_bound;  // none: progress fell
  double step_length = 0;
  std::vector<ChildSummary> children;
  bool is_pool = false;  // of resources: only its members' waits are known
};

// A node, and why it has its status; judge/summary/why.h.
struct WhySummary {
  struct Attempt {
    std::uint64_t tick = 0;
    std::string path, reason;
    std::uint64_t times = 1;  // in a row in this tick, without a reason
  };
  std::string path, kind;
  Status status = Status::Idle;
  std::size_t depth = 0;  // below the first
  bool is_held = false;
  std::size_t children = 0, agreeing = 0;
  std::string reason = {};
  std::uint64_t failed_attempts = 0;
  std::optional<std::uint64_t> attempts_since = {};  // where the recording begins
  std::vector<Attempt> attempts = {};                // the last of these
  std::vector<Attempt> others = {};                  // of the other children with the same result
  bool stood_still = false;                          // it failed because of --stall-fail
};

std::vector<WhySummary> summarize(std::span<const WhyLink> links, const Shape& shape);
SynchronizedSummary summarize(const SynchronizedMeasure& measure, std::string path,
                              std::string kind, const std::vector<std::string>& children);
// Says for what the bound and the end of a synchronized node do not hold.
void append_fall_notes(const Shape& shape, const MeasuredNode& node,
                       std::vector<std::string>& notes);

struct PeriodSummary {
  double p50 = 0, p99 = 0, max = 0;  // seconds from the start of a tick to the start of the next
};

// Seconds from the deadline of a tick to its start.
struct LatenessSummary {
  double p50 = 0, p99 = 0, max = 0;
  std::vector<std::uint64_t> ticks;  // by the binary digits of their lateness in ns
};

// The ticks of a leaf that was over the budget.
struct LeafTimingSummary {
  std::string path;
  bool is_sampled = false;  // not each call was timed: `calls`, p50 and p99 are estimated
  std::uint64_t calls = 0, over_budget = 0;  // ticks of the leaf, and those that were over it
  double p50 = 0, p99 = 0, max = 0;          // seconds
};

// The tick that took longest.
struct WorstTickSummary {
  std::uint64_t tick = 0;
  double took = 0;   // seconds
  std::string leaf;  // whose call took most of it, or "" when calls were not timed
  double leaf_took = 0;
};

// A link of a standstill: judge/measure/wait_chain.h.
struct StandstillLinkSummary {
  std::string node, kind, waiting, awaited;  // of nodes: their paths
  double waiting_at = 0, awaited_at = 0;
  Status awaited_status = Status::Idle;
  std::string resources = {};  // of a pool
};

struct StandstillSummary {
  Obstacle cause = Obstacle::Idle;
  double since = 0, reported = 0;  // seconds
  std::vector<StandstillLinkSummary> links;
  std::vector<std::string> lines;  // in words
  std::string failed = {};         // the node that --stall-fail ended, if any
  double failed_at = 0;            // seconds
};

struct PropertySummary {
  std::string name, text;
  PropertyVerdict verdict = PropertyVerdict::Open;
  std::optional<std::uint64_t> tick = {};  // that has decided; none: the end, or nothing
};

struct Summary {
  RunResult result = RunResult::Stopped;
  StopReason reason = StopReason::Completed;
  int signal = 0;                           // when reason is Signal
  std::string fault = {};                   // when reason is Fault: "Door/pull/arm: threw …"
  std::vector<WhySummary> why_failed = {};  // from the root down, when it failed
  std::string tick_limit = "--max-ticks";   // its giver, when reason is MaxTicks
  std::uint64_t ticks = 0;
  double seconds = 0;
  std::optional<PeriodSummary> period = {};      // real time only, and from two ticks on
  std::optional<LatenessSummary> lateness = {};  // real time only
  std::uint64_t overruns = 0, skipped = 0;
  std::optional<WorstTickSummary> worst = {};  // real time only
  std::uint64_t faults = 0;                    // of leaves after which the run went on
  std::uint64_t went_on = 0;                   // leaves that did so while they were held
  std::optional<double> tick_budget = {};      // seconds
  std::vector<LeafTimingSummary> over_budget = {};
  std::vector<SynchronizedSummary> synchronized_nodes = {};  // that a tick reached
  std::size_t never_reached = 0;                             // of the synchronized nodes
  std::vector<StandstillSummary> standstills = {};           // the first ones
  std::uint64_t more_standstills = 0;                        // than these
  std::vector<PropertySummary> properties = {};
  std::vector<std::string> notes = {};  // other facts for the user: a recording that is cut, …
};

void write_text(const Summary& summary, std::string& out, bool color);
// Parts of it, which `lockstep log info` prints too.
void write_text(std::span<const WhySummary> why_failed, std::string& out, bool color);
// Without the line above.
void write_links(std::span<const WhySummary> links, std::string& out, bool color);
void write_text(std::span<const SynchronizedSummary> nodes, std::size_t never_reached,
                std::string& out, bool color);

// The first few standstills, and how many more there are; each is some lines.
std::vector<std::vector<std::string>> standstill_notes(const Summary& summary);

// One line, no newline. docs/recording.md describes the keys.
std::string to_json(const Summary& summary);
Json json_of(const std::vector<PropertySummary>& properties);
// "grip: violated in tick 33"
std::string to_text(const PropertySummary& property, bool color);
// A part of it.
Json json_of_links(std::span<const WhySummary> links);

}  // namespace lockstep::host
