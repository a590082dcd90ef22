// Watches a run for standstills, reports each once, and keeps them for the summary.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/measure/stall.h"
#include "judge/summary/summary.h"
#include "trace/observer.h"

namespace lockstep::host {

// Whether a line that a recording has of a node says that --stall-fail has ended it in that tick.
bool tells_of_end(std::string_view path, std::string_view line);

class Standstills final : public Observer {
 public:
  static constexpr std::size_t kMost = 20;  // in the summary

  // On the tick thread, in the tick that shows it: the node that stands still, and what to say.
  using Tell = std::function<void(NodeIndex node, const std::vector<std::string>& lines)>;
  // Without a limit it reports only what failed() adds.
  Standstills(Shape shape, std::optional<Nanoseconds> limit, Tell tell);

  AskedOfRun asked() const override { return {.stood_still = &failed_}; }
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  // --stall-fail has ended it; run/stall_fail.h.
  void failed(const Standstill& standstill, NodeIndex node);

  void add_to(Summary& summary) const;

 private:
  struct Kept {
    NodeIndex node;  // of the head
    StandstillSummary summary;
  };
  void report(const Standstill& standstill);
  StandstillSummary* add(const Standstill& standstill);
  StandstillSummary* find(const Standstill& standstill);
  StandstillSummary summarize(const Standstill& standstill) const;

  const Shape shape_;
  std::optional<StallWatch> watch_;
  Tell tell_;
  std::vector<Kept> kept_;
  std::uint64_t count_ = 0;
  std::vector<NodeIndex> failed_;  // in the last tick
};

}  // namespace lockstep::host
