// What labels say of edges from one state to another, where it matters: in cycles. It is found by
// ticking from the states of those cycles once more, so that a search keeps it of no other edge.
#pragma once

#include <memory>

#include "verify/edge_merger.h"
#include "verify/worker_threads.h"

namespace lockstep::host {

struct CycleGraph {
  // The edges of all cycles, with all that labels say; null: those of the search have it.
  std::unique_ptr<Graph> graph;
  std::optional<SearchEnd> cut = {};  // why some edges are missing
};

CycleGraph label_cycles(const Graph& graph, const StateStore& store, WorkerThreads& workers,
                        const Expanders& expanders, SearchRoom& room);

}  // namespace lockstep::host
