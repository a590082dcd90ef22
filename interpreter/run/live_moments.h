// The Moments of a run that a Ticker makes: spans over what the engine has, and what is asked for
// besides. Does not allocate after the first tick.
#pragma once

#include <cstddef>
#include <vector>

#include "run/shape_of.h"
#include "trace/moment.h"

namespace lockstep::host {

class Ticker;
struct Tree;

class LiveMoments final : private LiveRun {
 public:
  // The tree must outlive this.
  explicit LiveMoments(const Tree& tree, const AskedOfRun& asked = {});
  LiveMoments(const LiveMoments&) = delete;
  LiveMoments& operator=(const LiveMoments&) = delete;

  // Before the first tick: makes room, which a tick may not. Else the first one does.
  void begin(Ticker& ticker) const;
  // As the run is between two ticks. Valid until the next call, and until the next tick.
  const Moment& now(Ticker& ticker);
  // Needed only if something is asked for.
  void before_tick(Ticker& ticker) {
    if (asks_progress_ || asks_within_) ask(ticker);
  }
  // Likewise.
  const Moment& after_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time);

 private:
  // A node that is asked for its progress, and who may have used it.
  struct Asked {
    NodeIndex node = 0;
    NodeIndex keeper = 0;
    std::size_t child = 0;  // its number there
    bool is_kept = false;
  };
  // A parallel that does not compare the progress of its children, or a pool: it keeps none.
  struct Plain {
    NodeIndex node = 0;
    bool is_asked = false;
    std::vector<NodeIndex> children = {};
    std::vector<double> progress = {};
  };
  double progress(NodeIndex node) override;
  void share_progress() override;
  Round round(NodeIndex node) override;
  bool is_held_at_barrier(NodeIndex member) override;
  bool faulted() const override;
  std::span<const Fault> tolerated() const override;
  std::span<const OutOfRange> out_of_range() const override;
  std::span<const WentOn> went_on() const override;

  void ask(Ticker& ticker);
  void bind(Ticker& ticker);
  void point_to_factors(Ticker& ticker);
  void take_used(Ticker& ticker);

  const Tree& tree_;
  Ticker* ticker_ = nullptr;  // of the last call
  std::vector<Asked> asked_;
  std::vector<Plain> plain_;
  std::vector<double> progress_;
  // Of a tick that is one moment: that of leaves, where a synchronized node has used another.
  std::vector<LeafProgress> own_progress_;
  std::vector<const double*> limits_;
  std::vector<std::span<const double>> uses_;
  std::vector<const double*> factors_;  // empty: nobody paces
  const std::vector<NodeIndex> synchronized_;
  const void* bound_ = nullptr;                      // where the engine keeps what these point to
  const std::vector<NodeIndex>* const stood_still_;  // null: of no tick
  bool asks_progress_, asks_within_, asks_progress_within_;
  Moment moment_;
};

}  // namespace lockstep::host
