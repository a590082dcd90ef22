#include "run/watched_leaves.h"

#include "engine/ticker.h"
#include "run/shape_of.h"

namespace lockstep::host {

WatchedLeaves::WatchedLeaves(const Tree& tree, const LeafModels& models, const Sources* sources)
    : shape_(shape_of(tree)),
      audit_(shape_, tree, models, sources),
      moments_(tree, audit_.asked()) {}

void WatchedLeaves::begin(Ticker& ticker) {
  moments_.begin(ticker);
  audit_.begin(moments_.now(ticker));
}

void WatchedLeaves::before_tick(Ticker& ticker) {
  audit_.before_tick(moments_.now(ticker));
  moments_.before_tick(ticker);
}

void WatchedLeaves::after_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  for (const Fault& it : ticker.tolerated()) audit_.note_fault(it.node);
  for (const LeafBreach& it : audit_.after_tick(moments_.after_tick(ticker, tick, time))) {
    ticker.report_fault(it.node, it.message);
    if (ticker.status(it.node) == Status::Running) audit_.note_fault(it.node);
  }
}

}  // namespace lockstep::host
