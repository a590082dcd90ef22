// A coverage is what the ticks of a search have shown of each node.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/ticker.h"
#include "verify/symmetry.h"

namespace lockstep::host {

class SearchCoverage {
 public:
  explicit SearchCoverage(const Tree& tree);

  // After each tick, before its state is folded.
  void after_tick(Ticker& ticker);
  void add(const SearchCoverage& other);
  // All nodes that can come to the place of one did what it did.
  void spread(const Symmetry& symmetry);

  bool was_ticked(NodeIndex node) const { return (seen_[node] & kTicked) != 0; }
  bool has_been(NodeIndex node, Status status) const {
    return (seen_[node] & 1u << index_of(status)) != 0;
  }
  // Timeouts that have ended their child.
  bool has_fired(NodeIndex node) const { return (seen_[node] & kFired) != 0; }

  // A synchronized node has the barriers at which somebody could be held, and how far its children
  // were apart.
  struct Synchronized {
    NodeIndex node;
    std::set<double> limits = {};
    double last_limit = -1;  // which is in it; -1: none
    double largest_spread = 0;
  };
  const std::vector<Synchronized>& synchronized() const { return synchronized_; }

 private:
  static constexpr std::uint8_t kTicked = 0x80, kFired = 0x40;

  void look_at(Ticker& ticker, Synchronized& it) const;
  static void add(const Synchronized& from, Synchronized& to);

  std::vector<NodeState> moment_;
  std::vector<std::uint8_t> seen_;  // of each node: a bit for each status, and these
  std::vector<NodeIndex> timeouts_;
  std::vector<Synchronized> synchronized_;
};

}  // namespace lockstep::host
