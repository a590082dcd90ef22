// Moves a dry tree as far as it goes, to see whether somebody is held for ever. Leaves gain
// progress in small steps and succeed, and nobody overtakes another one without need: among
// children that run at a time, the farthest stays where it would be held if the others were there
// too.
#pragma once

#include <cstdint>
#include <vector>

#include "tree/advise/dry_tree.h"

namespace lockstep::host {

class DryRun {
 public:
  enum class State : std::uint8_t { Idle, Running, LaterRounds, Done };

  explicit DryRun(const DryTree& tree);

  // Returns whether it stands still before the root is done. Of a tree for which that would take
  // too long, false.
  bool stands_still();

  // Where it stands:
  State state(std::uint32_t node) const { return states_[node]; }
  double progress(std::uint32_t node) const { return progress_[node]; }
  // The child at which a Sequence is.
  std::uint32_t current(std::uint32_t sequence) const { return places_[sequence]; }
  // A node that itself gains progress.
  bool gains(std::uint32_t node) const;
  // The lowest node that is held among this one and those around it, or none.
  std::uint32_t held(std::uint32_t node) const;
  // The one that a keeper waits for: with the least progress.
  std::uint32_t last_of(std::uint32_t keeper) const;
  // The progress at which a keeper holds now: of barriers, the next one; infinity: none is left.
  double limit(std::uint32_t keeper) const;

 private:
  // The least of some numbers, and how many of them there are.
  struct Least {
    double value = 0;
    std::uint32_t many = 0;
  };

  // How the progress of a leaf counts for what is around it: scale * progress + offset, where it is
  // the least of those that run at a time.
  struct Share {
    double scale = 1, offset = 0;

    double of(double progress) const { return scale * progress + offset; }
    void pass(const DryNode& node);
  };

  void begin(std::uint32_t node);
  void complete(std::uint32_t node);
  bool goes_on(std::uint32_t parent, std::uint32_t child);
  void rise(std::uint32_t node, double progress);
  void tell_keeper(std::uint32_t node);
  void wait(std::uint32_t leaf, std::uint32_t keeper);
  void advance(std::uint32_t leaf, bool overtakes);

  void rescan(std::uint32_t all);
  void rescan_kept(std::uint32_t keeper);
  bool update(Least& least, double before, double now);

  double counted(std::uint32_t node) const;
  bool holds(std::uint32_t keeper, double progress) const;
  double next_stop(std::uint32_t keeper, double progress) const;

  const DryTree& tree_;
  std::vector<State> states_;
  std::vector<double> progress_;
  std::vector<double> counted_;          // of each node with a keeper: as what it counts there
  std::vector<std::uint32_t> places_;    // Sequence: the current child; All: children not done
  std::vector<Least> least_;             // of the children of an All
  std::vector<Least> least_kept_;        // of each keeper
  std::vector<std::uint32_t> waits_at_;  // of each leaf: the keeper for whose limit it waits
  // The leaves that wait at each keeper, and some that no longer do.
  std::vector<std::vector<std::uint32_t>> waiting_;
  std::vector<std::uint32_t> beginning_;  // nodes
  std::vector<std::uint32_t> ready_;      // leaves that may be able to move
  std::vector<std::uint32_t> ahead_;      // leaves that would overtake others, if they still wait
  std::uint64_t work_ = 0;
};

}  // namespace lockstep::host
