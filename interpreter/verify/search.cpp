#include "verify/search.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <stdexcept>

#include "verify/cycle_labels.h"

namespace lockstep::host {
namespace {

// The states of a round are looked at by all threads, while nothing is added. So a round is short
// where states have many edges. None of these depends on the number of threads.
constexpr StateId kStatesOfRound = 8192, kStatesOfChunk = 32;
constexpr std::uint64_t kEdgesOfRound = 2'000'000;

class Searcher {
 public:
  Searcher(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
           double rate, const SearchLimits& limits)
      : tree_(tree),
        limits_(limits),
        counts_cuts_(models.cuts.most > 0),
        workers_(std::max(1u, limits.jobs)),
        result_(tree),
        room_{limits, monotonic_now()} {
    result_.store = StateStore(limits.hash_bits);
    result_.rising_answers = limits.rising_answers;
    result_.joins = limits.joins;
    result_.few_root_ticks = limits.few_root_ticks;
    result_.few_ticks = limits.few_ticks;
    if (limits.symmetry) result_.symmetry = Symmetry(tree, models, nodes_of(properties, tree));
    for (unsigned i = 0; i < std::max(1u, limits.jobs); ++i) {
      expanders_.push_back(
          std::make_unique<Expander>(tree, models, properties, rate, result_.symmetry, limits));
    }
    result_.graph.shape = expanders_[0]->label_shape();
    result_.graph.time_limit = result_.time_limit.get();
    merger_.emplace(expanders_, result_.graph);
  }

  SearchResult search() {
    add(expanders_[0]->first_state());
    result_.depths.push_back(0);
    for (StateId done = 0; done < result_.store.size();) {
      const StateId last =
          std::min(static_cast<StateId>(result_.store.size()), done + states_of_round());
      const StateId next = do_round(done, last);
      if (next == done) break;
      done = next;
      if (result_.store.keeps_hashes()) result_.store.forget_before(done);
    }
    chunks_ = {};
    if (limits_.cycles) label_edges_of_cycles();
    for (const auto& it : expanders_) result_.coverage.add(it->coverage());
    result_.coverage.spread(result_.symmetry);
    result_.took = monotonic_now() - room_.began;
    return std::move(result_);
  }

 private:
  std::uint32_t depth() const { return static_cast<std::uint32_t>(result_.depths.size()) - 1; }

  // As many as have so many edges, if those are like the ones so far, and do not go far over the
  // limit of transitions. A tick again counts as an edge.
  StateId states_of_round() const {
    const Graph& graph = result_.graph;
    const std::uint64_t edges_of_state =
        (graph.edges.size() + result_.root_ticks - result_.transitions) /
        std::max<std::uint64_t>(1, graph.expanded());
    const std::uint64_t wanted = std::clamp<std::uint64_t>(kEdgesOfRound / (edges_of_state + 1),
                                                           kStatesOfChunk, kStatesOfRound);
    // At least one: a round without states would never end the search.
    return static_cast<StateId>(
        std::clamp<std::uint64_t>(ticks_left() / (edges_of_state + 1), 1, wanted));
  }

  std::uint64_t ticks_left() const {
    return limits_.transitions - std::min(limits_.transitions, result_.root_ticks);
  }

  // Returns the first state that it has not looked at: `first` if a limit was reached.
  StateId do_round(StateId first, StateId last) {
    if (has_ended(first) || is_over(first)) return first;
    const StateId count = (last - first + kStatesOfChunk - 1) / kStatesOfChunk;
    if (chunks_.size() < count) chunks_.resize(count);
    std::atomic<StateId> next{0}, cut{count};  // chunks; nothing behind one that is cut counts
    std::atomic<std::uint64_t> ticks{0};       // nor behind those that use up the limit
    const auto work = [&](unsigned thread) {
      while (ticks <= ticks_left() && !room_.is_round_full()) {
        const StateId i = next++;
        if (i >= count || i > cut) return;
        const StateId from = first + i * kStatesOfChunk;
        chunks_[i].thread = thread;
        expanders_[thread]->expand(result_.store, from, std::min(last, from + kStatesOfChunk),
                                   room_, chunks_[i]);
        ticks += chunks_[i].root_ticks;
        if (!chunks_[i].states.back().cut) continue;
        for (StateId least = cut; i < least && !cut.compare_exchange_weak(least, i);) {
        }
      }
    };
    // To wake the others takes longer than one chunk does.
    count == 1 ? work(0) : workers_.work(work);
    const StateId made = std::min<StateId>(next, count);
    for (StateId i = 0; i < made; ++i) {
      if (is_over(first + i * kStatesOfChunk) || !put_together(chunks_[i])) return first;
    }
    return std::min(last, first + made * kStatesOfChunk);
  }

  // --- in the order of the states ----------------------------------------------------------------

  bool put_together(const Chunk& chunk) {
    numbers_.clear();
    Chunk::State begin;
    for (StateId i = 0; i < chunk.states.size(); ++i) {
      const Chunk::State& it = chunk.states[i];
      if (is_over(chunk.first + i)) return false;
      if ((chunk.first + i) % SearchResult::kStatesOfRow == 0) {
        result_.known.push_back(static_cast<StateId>(result_.store.size()));
      }
      result_.transitions += it.transitions;
      result_.root_ticks += it.root_ticks;
      for (std::size_t news = begin.news; news < it.news; ++news) {
        take(chunk.news[news], chunk.first + i);
      }
      for (auto fresh = static_cast<StateId>(begin.fresh); fresh < it.fresh; ++fresh) {
        numbers_.push_back(add(chunk.fresh[fresh]));
      }
      if (it.ends) result_.graph.ends[chunk.first + i] = true;
      if (it.cut) {
        if (*it.cut == SearchEnd::Signal) result_.signal = limits_.stop_signal();
        stop(*it.cut);
        return false;
      }
      merger_->add(chunk, begin.edges, it.edges, numbers_, it.end);
      if (!result_.graph.shape.moving_leaves.empty()) {
        result_.graph.equals.push_back(merger_->label_of(chunk, it.equals));
      }
      begin = it;
    }
    return true;
  }

  StateId add(std::span<const std::byte> state) {
    const auto [id, is_new] = result_.store.add(state);
    if (is_new) result_.graph.ends.push_back(false);
    if (is_new && counts_cuts_) result_.graph.cuts.push_back(StateCode::cuts_of(state));
    return id;
  }

  void label_edges_of_cycles() {
    // Also where the search was at a limit, something is left for them.
    SearchLimits limits = limits_;
    if (limits.time) *limits.time += *limits.time / 20;
    const TimeLimit::Span span(*result_.time_limit, limits.time
                                                        ? std::optional(room_.began + *limits.time)
                                                        : std::nullopt);
    limits.memory +=
        std::min(limits.memory / 8, std::numeric_limits<std::size_t>::max() - limits.memory);
    SearchRoom room{limits, room_.began, memory()};
    CycleGraph cycles = label_cycles(result_.graph, result_.store, workers_, expanders_, room);
    result_.cycles = std::move(cycles.graph);
    if (!cycles.cut) return;
    if (*cycles.cut == SearchEnd::Signal) result_.signal = limits_.stop_signal();
    stop(*cycles.cut);
  }

  void take(const News& news, StateId from) {
    const Occurrence here{from, depth() + 1, news.answers};
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
      case News::Kind::Passed:
        result_.passed.try_emplace(news.which, news.text, here);
        break;
      case News::Kind::Repeated:
        result_.repeated.try_emplace(news.which, here);
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
    return result_.root_ticks > limits_.transitions && stop(SearchEnd::Transitions);
  }

  // Before a round, this looks at all that depends on the machine.
  bool has_ended(StateId state) {
    room_.memory = memory();
    room_.of_round = 0;
    if (const auto end = room_.why_over()) {
      if (*end == SearchEnd::Signal) result_.signal = limits_.stop_signal();
      return stop(*end);
    }
    const Nanoseconds now = monotonic_now();
    if (limits_.tell && now - told_ > std::chrono::milliseconds(100)) {
      told_ = now;
      limits_.tell({result_.store.size(), result_.store.size() - state, result_.transitions,
                    depth(), room_.memory});
    }
    return false;
  }

  // All of it, with what is to come.
  std::size_t memory() const {
    std::size_t bytes = result_.memory() + merger_->memory();
    bytes += result_.store.size() * kLaterBytesOfState;
    for (const auto& it : expanders_) bytes += it->labels().memory();
    return bytes;
  }

  bool stop(SearchEnd end) {
    result_.end = end;
    return true;
  }

  const Tree& tree_;
  const SearchLimits& limits_;
  const bool counts_cuts_;
  WorkerThreads workers_;
  Expanders expanders_;
  std::vector<Chunk> chunks_;  // of a round
  SearchResult result_;
  std::optional<EdgeMerger> merger_;
  std::vector<StateId> numbers_;  // of the fresh states of a chunk
  std::map<std::uint32_t, std::set<std::string>> values_;
  StateId next_depth_ = 0;
  SearchRoom room_;
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

// States are found in the order of those that lead to them.
StateId SearchResult::found_from(StateId state) const {
  const auto row = std::ranges::upper_bound(known, state) - known.begin() - 1;
  for (auto from = static_cast<StateId>(row) * kStatesOfRow; from < graph.expanded(); ++from) {
    for (const Edge& edge : graph.edges_of(from)) {
      if (edge.to == state) return from;
    }
  }
  throw std::logic_error("no tick has found this state");
}

std::vector<StateId> SearchResult::path_to(StateId state) const {
  std::vector<StateId> path{state};
  while (path.back() != 0) path.push_back(found_from(path.back()));
  std::ranges::reverse(path);
  return path;
}

std::size_t SearchResult::memory() const {
  return store.memory() + known.size() * sizeof known[0] + graph.memory() +
         (cycles == nullptr ? 0 : cycles->memory());
}

SearchResult search(const Tree& tree, const LeafModels& models,
                    std::span<const Property> properties, double rate, const SearchLimits& limits) {
  return Searcher(tree, models, properties, rate, limits).search();
}

}  // namespace lockstep::host
