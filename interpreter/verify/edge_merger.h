// Puts edges that several threads have found into one graph: each thread numbers its labels.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "verify/expansion.h"
#include "verify/graph.h"

namespace lockstep::host {

using Expanders = std::vector<std::unique_ptr<Expander>>;  // one for each thread

class EdgeMerger {
 public:
  // Both must outlive this.
  EdgeMerger(const Expanders& expanders, Graph& graph)
      : expanders_(expanders), graph_(graph), labels_(expanders.size()) {}

  // Adds edges of a chunk as those of the next state. `numbers` are of its fresh states.
  void add(const Chunk& chunk, std::size_t first, std::size_t last,
           std::span<const StateId> numbers, std::optional<std::uint32_t> label_of_end);
  // The number that a label of a thread has in the graph.
  std::uint32_t label_of(const Chunk& chunk, std::uint32_t own_number);
  std::size_t memory() const;

 private:
  const Expanders& expanders_;
  Graph& graph_;
  std::vector<std::vector<std::uint32_t>> labels_;  // of each thread: their numbers in the graph
  std::vector<Edge> edges_;
};

}  // namespace lockstep::host
