#include "verify/search.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>

#include "verify/crew.h"

namespace lockstep::host {
namespace {

// The states of a round are looked at by all threads, while nothing is added. So a round is short
// where states have many edges. None of these depends on the number of threads.
constexpr StateId kStatesOfRound = 8192, kStatesOfChunk = 32;
constexpr std::uint64_t kEdgesOfRound = 2'000'000;

class Searcher {
 public:
  Searcher(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
           Nanoseconds period, const SearchLimits& limits)
      : tree_(tree), limits_(limits), crew_(std::max(1u, limits.jobs)), result_(tree) {
    result_.store = StateStore(limits.hash_bits);
    result_.rising_answers = limits.rising_answers;
    if (limits.symmetry) result_.symmetry = Symmetry(tree, models, nodes_of(properties, tree));
    for (unsigned i = 0; i < std::max(1u, limits.jobs); ++i) {
      expanders_.push_back(
          std::make_unique<Expander>(tree, models, properties, period, result_.symmetry, limits));
    }
    labels_.resize(expanders_.size());
    result_.graph.shape = expanders_[0]->label_shape();
  }

  SearchResult search() {
    add(expanders_[0]->first_state(), {});
    result_.depths.push_back(0);
    for (StateId done = 0; done < result_.store.size();) {
      const StateId last =
          std::min(static_cast<StateId>(result_.store.size()), done + states_of_round());
      if (!do_round(done, last)) break;
      done = last;
      if (result_.store.keeps_hashes()) result_.store.forget_before(done);
    }
    for (const auto& it : expanders_) result_.coverage.add(it->coverage());
    result_.coverage.spread(result_.symmetry);
    result_.took = monotonic_now() - began_;
    return std::move(result_);
  }

 private:
  std::uint32_t depth() const { return static_cast<std::uint32_t>(result_.depths.size()) - 1; }

  // As many as have so many edges, if those are like the ones so far, and do not go far over the
  // limit of transitions.
  StateId states_of_round() const {
    const Graph& graph = result_.graph;
    const std::uint64_t edges_of_state =
        graph.edges.size() / std::max<std::uint64_t>(1, graph.expanded());
    const std::uint64_t left =
        limits_.transitions - std::min(limits_.transitions, result_.transitions);
    const std::uint64_t wanted = std::clamp<std::uint64_t>(kEdgesOfRound / (edges_of_state + 1),
                                                           kStatesOfChunk, kStatesOfRound);
    // At least one: a round without states would never end the search.
    return static_cast<StateId>(std::clamp<std::uint64_t>(left / (edges_of_state + 1), 1, wanted));
  }

  // False: a limit was reached.
  bool do_round(StateId first, StateId last) {
    if (has_ended(first) || is_over(first)) return false;
    const StateId count = (last - first + kStatesOfChunk - 1) / kStatesOfChunk;
    if (chunks_.size() < count) chunks_.resize(count);
    std::atomic<StateId> next{0}, cut{count};  // chunks; nothing behind one that is cut counts
    const auto work = [&](unsigned thread) {
      for (StateId i = next++; i < count && i <= cut; i = next++) {
        const StateId from = first + i * kStatesOfChunk;
        chunks_[i].thread = thread;
        expanders_[thread]->expand(result_.store, from, std::min(last, from + kStatesOfChunk),
                                   began_, chunks_[i]);
        if (!chunks_[i].states.back().cut) continue;
        for (StateId least = cut; i < least && !cut.compare_exchange_weak(least, i);) {
        }
      }
    };
    // To wake the others takes longer than one chunk does.
    count == 1 ? work(0) : crew_.work(work);
    for (StateId i = 0; i < count; ++i) {
      if (!put_together(chunks_[i])) return false;
    }
    return true;
  }

  // --- in the order of the states ----------------------------------------------------------------

  bool put_together(const Chunk& chunk) {
    numbers_.clear();
    Chunk::State begin;
    for (StateId i = 0; i < chunk.states.size(); ++i) {
      const Chunk::State& it = chunk.states[i];
      if (is_over(chunk.first + i)) return false;
      result_.transitions += it.transitions;
      for (std::size_t news = begin.news; news < it.news; ++news) {
        take(chunk.news[news], chunk.first + i);
      }
      for (auto fresh = static_cast<StateId>(begin.fresh); fresh < it.fresh; ++fresh) {
        numbers_.push_back(
            add(chunk.fresh[fresh], chunk.found_by[fresh], hash_of(chunk.fresh[fresh])));
      }
      if (it.ends) result_.graph.ends[chunk.first + i] = true;
      if (it.cut) {
        result_.end = *it.cut;
        result_.signal = it.signal;
        return false;
      }
      add_edges(chunk, begin.edges, it.edges);
      if (!result_.graph.shape.moving_leaves.empty()) {
        result_.graph.equals.push_back(label_of(chunk, it.equals));
      }
      begin = it;
    }
    return true;
  }

  void add_edges(const Chunk& chunk, std::size_t first, std::size_t last) {
    const LabelTable& own = expanders_[chunk.thread]->labels();
    edges_.assign(chunk.edges.begin() + static_cast<std::ptrdiff_t>(first),
                  chunk.edges.begin() + static_cast<std::ptrdiff_t>(last));
    for (Edge& it : edges_) {
      if ((it.to & Chunk::kFresh) != 0) it.to = numbers_[it.to & ~Chunk::kFresh];
    }
    // By the bits, since each thread has its own numbers of labels.
    std::ranges::sort(edges_, [&](const Edge& a, const Edge& b) {
      if (a.to != b.to) return a.to < b.to;
      return a.label != b.label &&
             std::ranges::lexicographical_compare(own.packed(a.label), own.packed(b.label));
    });
    for (Edge& it : edges_) it.label = label_of(chunk, it.label);
    result_.graph.edges.add(edges_);
  }

  // The number that a label of a thread has in the graph.
  std::uint32_t label_of(const Chunk& chunk, std::uint32_t own_number) {
    const LabelTable& own = expanders_[chunk.thread]->labels();
    std::vector<std::uint32_t>& numbers = labels_[chunk.thread];
    if (numbers.size() < own.size()) numbers.resize(own.size(), kNoState);
    std::uint32_t& label = numbers[own_number];
    if (label == kNoState) label = result_.graph.labels.add(own.packed(own_number));
    return label;
  }

  StateId add(std::span<const std::byte> state, Step step) {
    return add(state, step, hash_of(state));
  }
  StateId add(std::span<const std::byte> state, Step step, std::uint64_t hash) {
    const auto [id, is_new] = result_.store.add(state, hash);
    if (is_new) {
      result_.before.push_back(step);
      result_.graph.ends.push_back(false);
    }
    return id;
  }

  void take(const News& news, StateId from) {
    const Occurrence here{{from, news.combination}, depth() + 1};
    switch (news.kind) {
      case News::Kind::Result:
        if (auto& first = result_.results[news.which]; !first) first = here;
        break;
      case News::Kind::Fault:
        result_.faults.try_emplace(news.which, news.text, here);
        break;
      case News::Kind::Broken:
        if (!result_.broken) result_.broken.emplace(news.text, here);
        break;
      case News::Kind::Violated:
        result_.violated.try_emplace(news.which, here);
        break;
      case News::Kind::EntryValue: {
        std::set<std::string>& known = values_[news.which];
        known.insert(news.text);
        if (known.size() > limits_.values) result_.note = tree_.slots[news.which].name;
        break;
      }
    }
  }

  // Before a round, and before the edges of a state are put to the others.
  bool is_over(StateId state) {
    if (state == next_depth_) {
      next_depth_ = static_cast<StateId>(result_.store.size());
      if (state != 0) result_.depths.push_back(state);
    }
    if (!result_.note.empty()) return stop(SearchEnd::Values);
    if (result_.store.size() > limits_.states) return stop(SearchEnd::States);
    if (limits_.depth && depth() >= *limits_.depth) return stop(SearchEnd::Depth);
    return result_.transitions > limits_.transitions && stop(SearchEnd::Transitions);
  }

  // Before a round, this looks at all that depends on the machine.
  bool has_ended(StateId state) {
    if (limits_.stop_signal && (result_.signal = limits_.stop_signal()) != 0) {
      return stop(SearchEnd::Signal);
    }
    const Nanoseconds now = monotonic_now();
    if (limits_.time && now - began_ > *limits_.time) return stop(SearchEnd::Time);
    const std::size_t memory = result_.memory();
    if (memory > limits_.memory) return stop(SearchEnd::Memory);
    if (limits_.tell && now - told_ > std::chrono::milliseconds(100)) {
      told_ = now;
      limits_.tell({result_.store.size(), result_.store.size() - state, result_.transitions,
                    depth(), memory});
    }
    return false;
  }

  bool stop(SearchEnd end) {
    result_.end = end;
    return true;
  }

  const Tree& tree_;
  const SearchLimits& limits_;
  Crew crew_;
  std::vector<std::unique_ptr<Expander>> expanders_;  // of each thread
  std::vector<std::vector<std::uint32_t>> labels_;    // of each thread: the numbers of its labels
  std::vector<Chunk> chunks_;                         // of a round
  SearchResult result_;
  std::vector<StateId> numbers_;  // of the fresh states of a chunk
  std::vector<Edge> edges_;
  std::map<std::uint32_t, std::set<std::string>> values_;
  StateId next_depth_ = 0;
  const Nanoseconds began_ = monotonic_now();
  Nanoseconds told_{0};
};

}  // namespace

std::uint32_t SearchResult::depth_of(StateId state) const {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(depths, state) - depths.begin()) - 1;
}

std::uint32_t SearchResult::complete_depth() const {
  const auto expanded = static_cast<StateId>(graph.expanded());
  if (expanded >= store.size()) return static_cast<std::uint32_t>(depths.size());
  return depth_of(expanded);
}

std::vector<Step> SearchResult::way_to(StateId state) const {
  std::vector<Step> way;
  for (; state != 0; state = before[state].from) way.push_back(before[state]);
  std::ranges::reverse(way);
  return way;
}

std::size_t SearchResult::memory() const {
  return store.memory() + before.size() * sizeof(Step) + graph.edges.memory() +
         graph.labels.memory() + graph.equals.size() * sizeof graph.equals[0];
}

SearchResult search(const Tree& tree, const LeafModels& models,
                    std::span<const Property> properties, Nanoseconds period,
                    const SearchLimits& limits) {
  return Searcher(tree, models, properties, period, limits).search();
}

}  // namespace lockstep::host
