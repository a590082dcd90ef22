#include "observers/recording_delta.h"

#include "engine/ticker.h"
#include "measure/synchronized_measure.h"
#include "observers/recording_text.h"

namespace lockstep {

RecordingDelta::RecordingDelta(const Tree& tree)
    : synchronized_nodes_(synchronized_nodes(tree)),
      progress_(tree.nodes.size()),
      kept_(tree.nodes.size()) {
  changes_.reserve(tree.nodes.size());
}

void RecordingDelta::before_tick(Ticker& ticker) {
  for (NodeIndex node = 0; node < progress_.size(); ++node) progress_[node] = ticker.progress(node);
}

void RecordingDelta::append(Ticker& ticker, fmt::memory_buffer& out) {
  take_snapshots(ticker);
  changes_.clear();
  for (NodeIndex node = 0; node < kept_.size(); ++node) {
    const RecordedState now{.status = ticker.status(node),
                            .progress = progress_[node],
                            .ticked = ticker.ticked(node),
                            .held = ticker.held(node)};
    if (now != kept_[node]) changes_.push_back({node, now});
  }
  for (const Change& change : changes_) {
    if (&change != changes_.data()) out.push_back(',');
    append_node(out, change.node, change.state);
  }
}

void RecordingDelta::keep() {
  for (const Change& change : changes_) kept_[change.node] = change.state;
}

// What a synchronized node has seen counts more than what was seen before its tick.
void RecordingDelta::take_snapshots(Ticker& ticker) {
  for (const NodeIndex node : synchronized_nodes_) {
    if (!ticker.ticked(node)) continue;
    NodeIndex child = node + 1;
    for (const double progress : child_progress(ticker, node)) {
      progress_[child] = progress;
      child = ticker.end_of(child);
    }
  }
}

}  // namespace lockstep
