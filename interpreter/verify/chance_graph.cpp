#include "verify/chance_graph.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "verify/labels.h"

namespace lockstep::host {
namespace {

using Target = DecisionProcess::Target;

const Symmetry kNothingMoves;

constexpr std::uint64_t kTicksBeforeLook = 64;  // at what depends on the machine

class ChanceExplorer {
 public:
  ChanceExplorer(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
                 double rate, const SearchLimits& limits)
      : limits_(limits),
        began_(monotonic_now()),
        stepper_(tree, models, properties, rate, kNothingMoves, false, kAllTicks, kAllTicks),
        labeller_(tree, models, properties.size(), kNothingMoves) {
    graph_.shape = labeller_.shape();
    stepper_.set_gives_up([this] { return is_over(); });
  }

  ChanceGraph explore() {
    graph_.unknown = graph_.process.add({}, false);
    store_.add(stepper_.first_state());
    while (graph_.looked_at < store_.size()) {
      if (store_.size() > limits_.states) graph_.end = SearchEnd::States;
      if (is_over() || !look_at(static_cast<StateId>(graph_.looked_at))) break;
      ++graph_.looked_at;
      tell();
    }
    graph_.states = store_.size();
    for (const ChanceGraph::TickEnd& it : graph_.ends) {
      if (it.to != kNoState) graph_.process.set_target(it.vertex, vertex_of(it.to));
    }
    graph_.first = vertex_of(0);
    graph_.took = monotonic_now() - began_;
    return std::move(graph_);
  }

 private:
  // A question of a tick, with what follows each answer.
  struct Open {
    const double* chances;
    std::vector<Vertex> follows = {};
  };

  Vertex vertex_of(StateId state) const {
    return state < begins_.size() ? begins_[state] : graph_.unknown;
  }

  bool is_over() {
    if (graph_.end == SearchEnd::Complete) {
      if (limits_.stop_signal && limits_.stop_signal() != 0) graph_.end = SearchEnd::Signal;
      if (limits_.time && monotonic_now() - began_ > *limits_.time) graph_.end = SearchEnd::Time;
      if (memory() > limits_.memory) graph_.end = SearchEnd::Memory;
    }
    return graph_.end != SearchEnd::Complete;
  }

  // With what is made of it later.
  std::size_t memory() const {
    return store_.memory() + vertices_.memory() + ends_memory_ + 3 * graph_.process.memory();
  }

  void tell() {
    const Nanoseconds now = monotonic_now();
    if (!limits_.tell || now - told_ < std::chrono::milliseconds(100)) return;
    told_ = now;
    limits_.tell({store_.size(), store_.size() - graph_.looked_at, graph_.ticks, 0, memory()});
  }

  // The questions of the ticks from a state are a tree, of which the ticks are walked in order.
  bool look_at(StateId state) {
    const auto bytes = store_[state];
    const StateBytes from(bytes.begin(), bytes.end());  // the store grows
    stepper_.load(from, state == 0);
    std::vector<Open> open;
    Vertex last = 0;
    const auto close = [&](std::size_t count) {
      while (open.size() > count) {
        last = vertex_for(open.back());
        open.pop_back();
        if (!open.empty()) open.back().follows.push_back(last);
      }
    };
    for (bool is_first = true; is_first || stepper_.next(); is_first = false) {
      if (!is_first) close(stepper_.answers().questions_left());
      const Status status = stepper_.tick();
      if (!stepper_.is_done()) return false;
      if (++graph_.ticks % kTicksBeforeLook == 0 && is_over()) return false;
      const auto questions = stepper_.answers().questions();
      for (std::size_t i = open.size(); i < questions.size(); ++i)
        open.push_back({questions[i].chances});
      last = end_of_tick(status);
      if (!open.empty()) open.back().follows.push_back(last);
    }
    close(0);
    begins_.push_back(last);
    return true;
  }

  // What is chosen twice in a row is one choice.
  Vertex vertex_for(const Open& open) {
    std::vector<Target> targets;
    if (open.chances == nullptr) {
      std::vector<Vertex> all;
      for (const Vertex it : open.follows) {
        if (!is_choice(it)) {
          all.push_back(it);
          continue;
        }
        for (const Target& target : graph_.process.edges_of(it)) all.push_back(target.to);
      }
      std::ranges::sort(all);
      all.erase(std::unique(all.begin(), all.end()), all.end());
      for (const Vertex it : all) targets.push_back({it, 0});
    } else {
      for (std::size_t i = 0; i < open.follows.size(); ++i) {
        const auto it = std::ranges::find(targets, open.follows[i], &Target::to);
        if (it == targets.end()) {
          targets.push_back({open.follows[i], open.chances[i]});
        } else {
          it->chance += open.chances[i];
        }
      }
      std::ranges::sort(targets, {}, &Target::to);
    }
    if (targets.size() == 1) return targets.front().to;
    return known(targets, open.chances != nullptr);
  }

  bool is_choice(Vertex vertex) const {
    return !graph_.process.is_by_chance(vertex) && graph_.process.edges_of(vertex).size() > 1;
  }

  // Equal ones are one.
  Vertex known(std::span<const Target> targets, bool is_by_chance) {
    bytes_.clear();
    const auto put = [this](const auto& it) {
      const auto bytes = std::as_bytes(std::span(&it, 1));
      bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    };
    for (const Target& it : targets) {
      put(it.to);
      put(it.chance);
    }
    const auto [number, is_new] = vertices_.add(bytes_);
    if (is_new) numbers_.push_back(graph_.process.add(targets, is_by_chance));
    return numbers_[number];
  }

  Vertex end_of_tick(Status status) {
    ChanceGraph::TickEnd end;
    for (const std::size_t it : stepper_.violated())
      end.violated.push_back(static_cast<std::uint32_t>(it));
    std::ranges::sort(end.violated);
    const bool has_fault = stepper_.ticker().fault() != nullptr;
    const bool is_over = status != Status::Running || has_fault;
    if (!is_over) {
      end.label = label();
      end.to = store_.add(stepper_.fold()).first;
    } else if (!has_fault) {
      end.result = status;
    }
    const std::size_t what = is_over ? 1 + (end.result ? index_of(*end.result) + 1 : 0) : 0;
    const auto [it, is_new] =
        known_ends_.try_emplace({what, end.to, end.label, end.violated}, Vertex{0});
    if (!is_new) return it->second;
    const Target next{graph_.unknown, 0};
    end.vertex =
        graph_.process.add(is_over ? std::span<const Target>() : std::span(&next, 1), false);
    ends_memory_ += sizeof(end) + sizeof(*it) + 64;
    graph_.ends.push_back(end);
    return it->second = end.vertex;
  }

  // What counts for runs that never end.
  std::uint32_t label() {
    Label label = labeller_.of(stepper_);
    const LabelShape& shape = labeller_.shape();
    for (std::size_t i = 0; i < shape.held; ++i) label.clear(shape.held_bit(i));
    label.clear(shape.begun_bit());
    return graph_.labels.add(label);
  }

  using EndKey = std::tuple<std::size_t, StateId, std::uint32_t, std::vector<std::uint32_t>>;

  const SearchLimits& limits_;
  const Nanoseconds began_;
  Nanoseconds told_{0};
  Stepper stepper_;
  Labeller labeller_;
  StateStore store_, vertices_;
  StateBytes bytes_;
  std::vector<Vertex> numbers_;  // of what is in `vertices_`
  std::map<EndKey, Vertex> known_ends_;
  std::size_t ends_memory_ = 0;
  std::vector<Vertex> begins_;  // of each state that was looked at
  ChanceGraph graph_;
};

}  // namespace

Vertex DecisionProcess::add(std::span<const Target> targets, bool is_by_chance) {
  targets_.insert(targets_.end(), targets.begin(), targets.end());
  first_.push_back(targets_.size());
  is_by_chance_.push_back(is_by_chance);
  return static_cast<Vertex>(states() - 1);
}

ChanceGraph explore_chances(const Tree& tree, const LeafModels& models,
                            std::span<const Property> properties, double rate,
                            const SearchLimits& limits) {
  return ChanceExplorer(tree, models, properties, rate, limits).explore();
}

}  // namespace lockstep::host
