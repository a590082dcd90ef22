// The strongly connected components of a graph.
#pragma once

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "verify/graph.h"

namespace lockstep::host {

// Tarjan's algorithm without recursion, of the whole graph or of some states again and again: no
// two components have the same number, and one has a smaller number than those that lead to it.
template <class G = Graph>
class Components {
 public:
  explicit Components(const G& graph)
      : graph_(graph),
        of_(graph.states(), kNoState),
        index_(graph.states(), kNoState),
        low_(graph.states()) {}

  std::uint32_t of(StateId state) const { return of_[state]; }
  std::uint32_t count() const { return count_; }

  // Finds the components of these states over the edges that `uses` says, which do not lead out of
  // them.
  template <class Uses>
  void find(const std::vector<StateId>& states, const Uses& uses) {
    for (const StateId state : states) of_[state] = index_[state] = kNoState;
    for (const StateId state : states) {
      if (index_[state] == kNoState) visit(state, uses);
    }
  }

  // These states, component after component: those that one leads to come before it.
  std::vector<StateId> in_order(const std::vector<StateId>& states) const {
    std::vector<std::uint32_t> begins(count_ + 1);
    for (const StateId state : states) ++begins[of_[state] + 1];
    for (std::uint32_t i = 0; i < count_; ++i) begins[i + 1] += begins[i];
    std::vector<StateId> order(states.size());
    for (const StateId state : states) order[begins[of_[state]]++] = state;
    return order;
  }

  // Those of the last call in which an edge goes from one state to another.
  template <class Uses>
  std::vector<std::vector<StateId>> with_cycles(const std::vector<StateId>& states,
                                                const Uses& uses) const {
    std::vector<std::vector<StateId>> found;
    std::unordered_map<std::uint32_t, std::size_t> places;
    for (const StateId state : states) {
      for (const auto& edge : graph_.edges_of(state)) {
        if (of_[edge.to] != of_[state] || !uses(state, edge)) continue;
        places.try_emplace(of_[state], places.size());
        break;
      }
    }
    found.resize(places.size());
    for (const StateId state : states) {
      if (const auto it = places.find(of_[state]); it != places.end()) {
        found[it->second].push_back(state);
      }
    }
    return found;
  }

 private:
  using Row = decltype(std::declval<const G&>().edges_of(StateId{}));
  struct Frame {
    StateId state;
    decltype(std::declval<Row>().begin()) next;
    decltype(std::declval<Row>().end()) end;
  };

  template <class Uses>
  void visit(StateId root, const Uses& uses) {
    enter(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      const StateId state = frame.state;
      if (frame.next == frame.end) {
        frames_.pop_back();
        if (low_[state] == index_[state]) close(state);
        if (!frames_.empty()) {
          low_[frames_.back().state] = std::min(low_[frames_.back().state], low_[state]);
        }
        continue;
      }
      const auto edge = *frame.next;
      ++frame.next;
      if (!uses(state, edge)) continue;
      if (index_[edge.to] == kNoState) {
        enter(edge.to);
      } else if (of_[edge.to] == kNoState) {
        low_[state] = std::min(low_[state], index_[edge.to]);
      }
    }
  }

  void enter(StateId state) {
    index_[state] = low_[state] = next_++;
    stack_.push_back(state);
    const auto row = graph_.edges_of(state);
    frames_.push_back({state, row.begin(), row.end()});
  }

  void close(StateId root) {
    StateId state = kNoState;
    do {
      state = stack_.back();
      stack_.pop_back();
      of_[state] = count_;
    } while (state != root);
    ++count_;
  }

  const G& graph_;
  std::vector<std::uint32_t> of_, index_, low_;
  std::vector<StateId> stack_;
  std::vector<Frame> frames_;
  std::uint32_t next_ = 0, count_ = 0;
};

}  // namespace lockstep::host
