#include "verify/expansion.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/blackboard.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kTicksBetweenCuts = 1000;
constexpr std::uint64_t kTicksBetweenLooks = 64;            // at what depends on the machine
constexpr std::uint64_t kNodesOfTick = 1000;                // a tick of more counts as several
constexpr std::size_t kLeastRound = std::size_t{1} << 20u;  // bytes

std::string passed_text(const Tree& tree, const BarrierWatch::Passed& it) {
  return fmt::format("'{}' passes {:.6g} while '{}' is before it", tree.path(it.child), it.barrier,
                     tree.path(it.late));
}

void sort_edges(Chunk& chunk, std::size_t first) {
  const auto begin = chunk.edges.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, chunk.edges.end());
  chunk.edges.erase(std::unique(begin, chunk.edges.end()), chunk.edges.end());
}

}  // namespace

void Chunk::clear() {
  states.clear();
  edges.clear();
  fresh.clear();
  news.clear();
  root_ticks = 0;
}

std::size_t Chunk::memory() const {
  return 2 * fresh.memory() + fresh.size() * kLaterBytesOfState + edges.size() * sizeof edges[0] +
         states.size() * sizeof states[0];
}

std::optional<SearchEnd> SearchRoom::why_over() const {
  if (limits.stop_signal && limits.stop_signal() != 0) return SearchEnd::Signal;
  if (limits.time && monotonic_now() - began > *limits.time) return SearchEnd::Time;
  if (memory + of_round > limits.memory) return SearchEnd::Memory;
  return std::nullopt;
}

bool SearchRoom::is_round_full() const {
  return of_round > std::max(kLeastRound, limits.memory / 8);
}

Expander::Expander(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
                   double rate, const Symmetry& symmetry, const SearchLimits& limits)
    : limits_(limits),
      stepper_(tree, models, properties, rate, symmetry, limits.rising_answers,
               limits.few_root_ticks, limits.few_ticks, limits.joins),
      labeller_(tree, models, properties.size(), symmetry),
      coverage_(tree) {
  for (std::uint32_t slot = 0; slot < models.entries.size(); ++slot) {
    if (models.entries[slot]) values_.emplace_back(slot, std::set<std::string>());
  }
  stepper_.set_gives_up([this] { return is_over(kTicksBetweenLooks); });
}

void Expander::begin(const StateStore& known, SearchRoom& room, Chunk& into) {
  known_ = &known;
  room_ = &room;
  chunk_ = &into;
  counted_ = 0;
  over_.reset();
  into.clear();
}

void Expander::count_memory() {
  const std::size_t memory = chunk_->memory();
  room_->of_round += memory - counted_;
  counted_ = memory;
}

// After so many ticks more.
bool Expander::is_over(std::uint64_t ticks) {
  ticks_since_look_ += ticks;
  if (over_ || ticks_since_look_ < kTicksBetweenLooks) return over_.has_value();
  ticks_since_look_ = 0;
  count_memory();
  over_ = room_->why_over();
  return over_.has_value();
}

void Expander::expand(const StateStore& known, StateId first, StateId last, SearchRoom& room,
                      Chunk& into) {
  begin(known, room, into);
  most_root_ticks_ = limits_.transitions;
  into.first = first;
  for (StateId state = first; state < last; ++state) {
    labeller_.shape().clear(end_);
    for_each_tick(
        state, known[state], into, [&](Status status) { take(state, status, into); },
        [&] { return why_cut(into); });
    const bool some_are_held =
        std::ranges::any_of(end_.bits, [](std::byte it) { return it != std::byte{0}; });
    if (some_are_held) into.states.back().end = labels_.add(end_);
    if (into.states.back().cut) break;
  }
  count_memory();
}

void Expander::expand_again(const StateStore& known, std::span<const StateId> states,
                            const BytesOf& bytes_of, const EdgeWanted& is_wanted, SearchRoom& room,
                            Chunk& into) {
  begin(known, room, into);
  most_root_ticks_ = std::numeric_limits<std::uint64_t>::max();
  for (const StateId state : states) {
    const auto take_again = [&](Status status) {
      if (status != Status::Running || stepper_.ticker().faulted()) return;
      labeller_.of(stepper_);
      const StateBytes& goal = stepper_.fold();
      const StateId to = known_->find(goal, hash_of(goal));
      if (to == kNoState || !is_wanted(state, to, goal)) return;
      into.edges.push_back({to, labels_.add(labeller_.with_moves(stepper_))});
    };
    for_each_tick(state, bytes_of(state), into, take_again, [] { return std::nullopt; });
    if (into.states.back().cut) break;
  }
  count_memory();
}

template <class Take, class Cut>
void Expander::for_each_tick(StateId state, std::span<const std::byte> bytes, Chunk& into,
                             const Take& take, const Cut& why_cut) {
  stepper_.load(bytes, state == 0);
  const std::size_t first_edge = into.edges.size();
  Chunk::State& at = into.states.emplace_back();
  if (!labeller_.shape().moving_leaves.empty()) at.equals = labels_.add(labeller_.equals(stepper_));
  const std::uint64_t weight = 1 + stepper_.ticker().tree().nodes.size() / kNodesOfTick;
  std::uint64_t next_cut = kTicksBetweenCuts;
  std::size_t most_edges = first_edge + 10 * kTicksBetweenCuts;
  do {
    const std::optional<Status> status = tick(at, into);
    if (!status) break;
    if (stepper_.is_known()) {
      coverage_.after_tick(stepper_.ticker());
    } else {
      take(*status);
    }
    if (!at.cut && is_over(stepper_.root_ticks() * weight)) at.cut = over_;
    if (at.cut || at.root_ticks * weight < next_cut) continue;
    next_cut = at.root_ticks * weight + kTicksBetweenCuts;
    if (into.edges.size() > most_edges) {
      sort_edges(into, first_edge);
      most_edges = 2 * into.edges.size() + kTicksBetweenCuts;
    }
    at.cut = why_cut();
  } while (!at.cut && stepper_.next());
  sort_edges(into, first_edge);
  at.edges = into.edges.size();
  at.fresh = into.fresh.size();
  at.news = into.news.size();
}

// Nothing if a limit ends it.
std::optional<Status> Expander::tick(Chunk::State& at, Chunk& into) {
  const std::uint64_t left = most_root_ticks_ - std::min(most_root_ticks_, into.root_ticks);
  const Status status = stepper_.tick(std::max<std::uint64_t>(1, left));
  at.root_ticks += stepper_.root_ticks();
  into.root_ticks += stepper_.root_ticks();
  ++at.transitions;
  if (stepper_.is_done()) return status;
  at.cut = over_.value_or(SearchEnd::Transitions);
  return std::nullopt;
}

// Cuts off one state with very many answers. Where a chunk begins does not depend on the threads,
// so what counts states and ticks ends at the same one.
std::optional<SearchEnd> Expander::why_cut(const Chunk& chunk) const {
  if (known_->size() + chunk.fresh.size() > limits_.states) return SearchEnd::States;
  if (chunk.root_ticks > limits_.transitions) return SearchEnd::Transitions;
  return std::nullopt;
}

void Expander::take(StateId from, Status status, Chunk& into) {
  Ticker& ticker = stepper_.ticker();
  coverage_.after_tick(ticker);
  for (const std::size_t it : stepper_.violated()) tell(News::Kind::Violated, it, into);
  if (!stepper_.leaves().broken().empty()) {
    tell(News::Kind::Broken, 0, into, stepper_.leaves().broken());
  }
  if (const auto passed = stepper_.passed()) {
    tell(News::Kind::Passed, passed->node, into, passed_text(ticker.tree(), *passed));
  }
  if (stepper_.was_cut()) tell_repeated(into);
  if (const Fault* fault = ticker.fault()) {
    tell(News::Kind::Fault, fault->node, into, fault->message);
    into.states.back().ends |= !stepper_.was_cut();
    return;
  }
  if (status != Status::Running) {
    tell(News::Kind::Result, index_of(status), into);
    into.states.back().ends |= !stepper_.was_cut();
    labeller_.add_held(stepper_, end_);
    return;
  }
  look_at_values(into);
  labeller_.of(stepper_);
  const StateBytes& state = stepper_.fold();
  const std::uint64_t hash = hash_of(state);
  StateId to = known_->find(state, hash);
  if (to == kNoState) {
    to = into.fresh.add(state, hash).first | Chunk::kFresh;
  }
  const bool is_loop = to == from;
  into.edges.push_back(
      {to, labels_.add(is_loop ? labeller_.with_moves(stepper_) : labeller_.only_held(stepper_))});
}

void Expander::tell_repeated(Chunk& into) {
  for (const CutLeaf& it : stepper_.cut_leaves()) {
    if (!stepper_.repeats(it)) continue;
    tell(News::Kind::Repeated, stepper_.ticker().tree().leaves[it.place].node, into);
  }
}

void Expander::tell(News::Kind kind, std::size_t which, Chunk& into, const std::string& text) {
  if (!told_.insert({kind, which}).second) return;
  into.news.push_back({kind, static_cast<std::uint32_t>(which), text, stepper_.answers().asked()});
}

// An entry with more and more values has no end of states.
void Expander::look_at_values(Chunk& into) {
  for (auto& [slot, known] : values_) {
    const Value& value = stepper_.ticker().blackboard().entries[slot].value();
    if (std::holds_alternative<NoValue>(value) || known.size() > limits_.values) continue;
    const auto [it, is_new] = known.insert(to_text(value));
    if (is_new) into.news.push_back({News::Kind::EntryValue, slot, *it});
  }
}

}  // namespace lockstep::host
