// The aspects of each node of a tree that ticks have shown. The ticks may be those of scenarios, or
// of a search over all behaviors.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "engine/tree.h"
#include "trace/observer.h"

namespace lockstep::host {

// An aspect may be seen of a node.
enum class Aspect : std::uint8_t { Ticked, Success, Failure, Skipped, Halted, Held };
inline constexpr std::array<std::string_view, 6> kAspects{"ticked",  "success", "failure",
                                                          "skipped", "halted",  "held"};
inline constexpr std::size_t kAspectCount = kAspects.size();

struct AspectSet {
  std::uint8_t bits = 0;

  bool has(Aspect aspect) const { return (bits >> static_cast<unsigned>(aspect) & 1u) != 0; }
  void add(Aspect aspect) {
    bits |= static_cast<std::uint8_t>(1u << static_cast<unsigned>(aspect));
  }
};

class NodeCoverage {
 public:
  explicit NodeCoverage(const Tree& tree);

  // `before` is the activity of the nodes before a tick; the Moment is after it.
  void add(std::span<const Activity> before, const Moment& moment);
  void add(const NodeCoverage& other);

  AspectSet seen(NodeIndex node) const { return seen_[node]; }
  std::uint64_t ticks(NodeIndex node) const { return ticks_[node]; }  // that reached it
  // Each node with constant barriers, and whether somebody has waited at each of them.
  const std::map<NodeIndex, std::map<double, bool>>& barriers() const { return barriers_; }

 private:
  void add(NodeIndex node, NodeState now);
  void add(const NodeTotals& totals);
  void add_barriers(const Moment& moment);

  const Tree& tree_;
  std::vector<NodeState> before_, moment_;
  std::vector<AspectSet> seen_;
  std::vector<std::uint64_t> ticks_;
  std::map<NodeIndex, std::map<double, bool>> barriers_;
};

// The coverage of runs.
class RunCoverage final : public Observer {
 public:
  explicit RunCoverage(const Tree& tree) : coverage_(tree) {}

  AskedOfRun asked() const override { return {.within = true}; }
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;

  const NodeCoverage& coverage() const { return coverage_; }

 private:
  NodeCoverage coverage_;
  std::vector<Activity> before_;
};

}  // namespace lockstep::host
