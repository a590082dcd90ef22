#include "verify/cycle_labels.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <unordered_set>

#include "verify/components.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kStatesAgain = 8192, kStatesOfPart = 32;

class CycleLabels {
 public:
  CycleLabels(const Graph& graph, const StateStore& store, WorkerThreads& workers,
              const Expanders& expanders, SearchRoom& room)
      : graph_(graph),
        store_(store),
        workers_(workers),
        expanders_(expanders),
        room_(room),
        memory_(room.memory),
        components_(graph) {}

  CycleGraph find() {
    CycleGraph found;
    std::vector<StateId> states;
    try {
      states = states_in_cycles();
    } catch (const OutOfTime&) {
      found.cut = SearchEnd::Time;
    }
    if (states.empty() && !found.cut) return found;
    // Without edges where the time is over: without labels they would say something false.
    found.graph = std::make_unique<Graph>();
    found.graph->ends = graph_.ends;
    found.graph->shape = graph_.shape;
    found.graph->time_limit = graph_.time_limit;
    if (found.cut) return found;
    // States that were forgotten are found again, all in their order.
    if (store_.keeps_hashes()) {
      states = expanded_states();
      made_.add(expanders_[0]->first_state());
    }
    EdgeMerger merger(expanders_, *found.graph);
    for (std::size_t first = 0; first < states.size();) {
      room_.memory = memory_ + found.graph->memory() + made_.memory() + merger.memory();
      room_.of_round = 0;
      found.cut = room_.why_over();
      if (found.cut) break;
      // At a limit there are states that were made, and not looked at.
      const std::size_t there =
          store_.keeps_hashes() ? std::min(made_.size(), states.size()) : states.size();
      const std::size_t count = std::min(kStatesAgain, there - first);
      const auto round = std::span(states).subspan(first, count);
      if (store_.keeps_hashes()) made_.forget_before(round.front());
      const std::size_t done = do_round(round, merger, *found.graph, found.cut);
      if (found.cut) break;
      first += done;
    }
    add_loops_until(static_cast<StateId>(graph_.expanded()), *found.graph);
    return found;
  }

 private:
  struct Part {
    Chunk chunk;
    // States that were not found again before the round, in the order in which they were.
    std::vector<std::pair<StateId, StateBytes>> made = {};
    std::unordered_set<StateId> made_here = {};
  };

  std::vector<StateId> expanded_states() const {
    std::vector<StateId> states(graph_.expanded());
    std::iota(states.begin(), states.end(), StateId{0});
    return states;
  }

  // Without those that are a cycle by themselves: the label of that edge says all.
  std::vector<StateId> states_in_cycles() {
    std::vector<StateId> states = expanded_states();
    components_.find(states, [](StateId, const Edge&) { return true; });
    std::vector<std::uint32_t> sizes(components_.count());
    for (const StateId state : states) ++sizes[components_.of(state)];
    std::erase_if(states, [&](StateId state) { return sizes[components_.of(state)] == 1; });
    return states;
  }

  // Returns how many it has done.
  std::size_t do_round(std::span<const StateId> states, EdgeMerger& merger, Graph& into,
                       std::optional<SearchEnd>& cut) {
    std::vector<Part> parts((states.size() + kStatesOfPart - 1) / kStatesOfPart);
    std::atomic<std::size_t> next{0};
    workers_.work([&](unsigned thread) {
      while (!room_.is_round_full()) {
        const std::size_t i = next++;
        if (i >= parts.size()) return;
        const std::size_t first = i * kStatesOfPart;
        expand(states.subspan(first, std::min(kStatesOfPart, states.size() - first)), thread,
               parts[i]);
      }
    });
    auto state = states.begin();
    parts.resize(std::min<std::size_t>(next, parts.size()));
    for (const Part& part : parts) {
      std::size_t first_edge = 0;
      for (const Chunk::State& it : part.chunk.states) {
        cut = it.cut;
        if (cut) return 0;
        add_loops_until(*state, into);
        merger.add(part.chunk, first_edge, it.edges, {}, {});
        add_equals(*state++, into);
        first_edge = it.edges;
      }
      for (const auto& [id, bytes] : part.made) {
        if (id == made_.size()) made_.add(bytes);
      }
    }
    return static_cast<std::size_t>(state - states.begin());
  }

  void expand(std::span<const StateId> states, unsigned thread, Part& part) {
    part.chunk.thread = thread;
    const auto bytes_of = [&](StateId state) {
      return store_.keeps_hashes() ? made_[state] : store_[state];
    };
    const auto is_wanted = [&](StateId from, StateId to, const StateBytes& goal) {
      const bool is_made = store_.keeps_hashes() && to >= made_.size();
      if (is_made && part.made_here.insert(to).second) part.made.emplace_back(to, goal);
      return to < graph_.expanded() && components_.of(from) == components_.of(to);
    };
    expanders_[thread]->expand_again(store_, states, bytes_of, is_wanted, room_, part.chunk);
  }

  // The states before this one are in no cycle of several states.
  void add_loops_until(StateId last, Graph& into) {
    for (auto state = static_cast<StateId>(into.expanded()); state < last; ++state) {
      loops_.clear();
      for (const Edge& edge : graph_.edges[state]) {
        if (edge.to == state) {
          loops_.push_back({state, into.labels.add(graph_.labels.packed(edge.label))});
        }
      }
      into.edges.add(loops_);
      add_equals(state, into);
    }
  }

  void add_equals(StateId state, Graph& into) const {
    if (graph_.equals.empty()) return;
    into.equals.push_back(into.labels.add(graph_.labels.packed(graph_.equals[state])));
  }

  const Graph& graph_;
  const StateStore& store_;
  WorkerThreads& workers_;
  const Expanders& expanders_;
  SearchRoom& room_;
  const std::size_t memory_;  // before
  Components<> components_;
  ByteRows made_;  // states that are found again
  std::vector<Edge> loops_;
};

}  // namespace

CycleGraph label_cycles(const Graph& graph, const StateStore& store, WorkerThreads& workers,
                        const Expanders& expanders, SearchRoom& room) {
  return CycleLabels(graph, store, workers, expanders, room).find();
}

}  // namespace lockstep::host
