// What labels say of edges from one state to another, where it matters: in cycles. It is found by
// ticking from the states of those cycles once more, so that a search keeps it of no other edge.
#pragma once

#include <memory>

#include "verify/crew.h"
#include "verify/edge_merger.h"

namespace lockstep::host {

struct CycleGraph {
  // The edges of all cycles, with all that labels say; null: those of the search have it.
  std::unique_ptr<Graph> graph;
  int signal = 0;  // why some edges are missing
};

// `signal`: has stopped the search, so no tick is made any more; 0: none has.
CycleGraph label_cycles(const Graph& graph, const StateStore& store, Crew& crew,
                        const Expanders& expanders, int signal);

}  // namespace lockstep::host
