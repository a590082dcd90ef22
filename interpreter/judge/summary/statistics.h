// Measures a run for its summary: tick periods, and every synchronized node. Does not allocate
// while the run ticks, except to note a leaf's fault and why the root failed. Prints nothing.
#pragma once

#include <vector>

#include "base/core/histogram.h"
#include "judge/measure/synchronized_measure.h"
#include "judge/summary/capped_notes.h"
#include "judge/summary/summary.h"
#include "trace/observer.h"
#include "trace/shape.h"

namespace lockstep::host {

class Statistics final : public Observer {
 public:
  explicit Statistics(Shape shape);
  // The run began before what comes first: it continues after a cut.
  void join();

  AskedOfRun asked() const override { return why_.asked(); }
  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // Complete once the run has ended.
  Summary summary() const;

 private:
  void note(const Fault& fault, std::uint64_t tick);
  std::optional<WorstTickSummary> worst_tick() const;
  SynchronizedSummary summary_of(const MeasuredNode& measured) const;

  const Shape shape_;
  std::vector<MeasuredNode> nodes_;
  Histogram periods_;
  Histogram lateness_{Histogram::kCoarse};
  bool real_time_ = false;
  std::optional<Nanoseconds> last_start_;  // of a tick
  WhyWatch why_{shape_};
  std::vector<WhyLink> why_failed_;
  CappedNotes faults_{"fault"};  // after which the run went on
  std::vector<std::string> progress_notes_;
  std::uint64_t went_on_ = 0;
  RunEnd end_;
};

// "the leaf 'Main/arm' (Advance of plugin 'motion')" or "the node 'Main/Wait' (Wait)".
std::string describe_node(const Shape& shape, NodeIndex node);
// "failed in tick 11", in a run of 12 ticks.
std::string failure_text(const Fault& fault, std::uint64_t ticks, std::uint64_t first_tick = 0);
// "the leaf 'Door/pull/arm' failed in tick 12: threw …; counted as Failure"
std::string fault_text(const Shape& shape, const Fault& fault, std::uint64_t tick);
// "Door/pull/arm: threw …"; in the last halt, the message begins so.
inline constexpr std::string_view kNotHalted = "could not be halted: ";
std::string fault_text(const Shape& shape, const Fault& fault);

// "the leaf 'Door/pull/arm' reported …" of the first few leaves whose progress was no share, and
// how many there are; "… went on while it was held …" in the same way.
std::vector<std::string> progress_notes(const Shape& shape, const LiveRun& run);

}  // namespace lockstep::host
