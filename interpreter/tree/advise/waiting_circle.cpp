#include "tree/advise/waiting_circle.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace lockstep::host {
namespace {

// A depth-first search, with an explicit stack. What must be before what is a graph of four kinds
// of vertices, so that it has no more edges than the tree:
//   a group                   -> Done of its members: they complete together
//   Done of a node            -> Done of its parent; of a Sequence's child also Next of the node
//   Next of a child           -> Begun and Next of the child after it
//   Begun of a node           -> Begun of its children; of a member also its group
// A node is only after another where a way leads through Next, so every circle has a group in it.
class Search {
 public:
  explicit Search(const Definition& definition) : definition_(definition) {
    for (std::uint32_t i = 0; i < definition.groups.size(); ++i) {
      if (!definition.waits(definition.groups[i])) continue;
      for (const std::uint32_t member : definition.groups[i].members) groups_.emplace(member, i);
    }
    states_.resize(kKinds * definition.nodes.size());
  }

  std::vector<WaitingLink> run() {
    for (std::uint32_t i = 0; i < definition_.groups.size(); ++i) {
      if (definition_.waits(definition_.groups[i]) && follow({Group, i})) return circle();
    }
    return {};
  }

 private:
  enum Kind : std::uint8_t { Group, Done, Next, Begun };
  static constexpr std::size_t kKinds = 4;
  enum class State : std::uint8_t { New, Open, Closed };
  struct Vertex {
    Kind kind;
    std::uint32_t index;  // of a node; of a group in Definition::groups
    friend bool operator==(const Vertex&, const Vertex&) = default;
  };
  struct Step {
    Vertex vertex;
    std::uint32_t edge = 0;   // the one to follow next
    std::uint32_t child = 0;  // Begun: the node it leads to
  };

  State& state(Vertex vertex) { return states_[kKinds * vertex.index + vertex.kind]; }
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  // True when a circle closes: it is at the end of the stack then.
  bool follow(Vertex first) {
    if (state(first) != State::New) return false;
    open(first);
    while (!stack_.empty()) {
      const auto to = next_of(stack_.back());
      if (!to) {
        state(stack_.back().vertex) = State::Closed;
        stack_.pop_back();
      } else if (state(*to) == State::Open) {
        closed_at_ = *to;
        return true;
      } else if (state(*to) == State::New) {
        open(*to);
      }
    }
    return false;
  }

  void open(Vertex vertex) {
    state(vertex) = State::Open;
    stack_.push_back({vertex, 0, vertex.index + 1});
  }

  std::optional<Vertex> next_of(Step& step) const {
    switch (step.vertex.kind) {
      case Group:
        return of_group(step);
      case Done:
        return of_done(step);
      case Next:
        return of_next(step);
      case Begun:
        return of_begun(step);
    }
    return std::nullopt;
  }

  std::optional<Vertex> of_group(Step& step) const {
    const auto& members = definition_.groups[step.vertex.index].members;
    if (step.edge == members.size()) return std::nullopt;
    return Vertex{Done, members[step.edge++]};
  }

  std::optional<Vertex> of_done(Step& step) const {
    const std::uint32_t node = step.vertex.index, parent = at(node).parent;
    if (parent == node) return std::nullopt;
    if (step.edge++ == 0) return Vertex{Done, parent};
    const bool is_sequence = at(parent).type->goes_on_after == Status::Success;
    return step.edge == 2 && is_sequence ? std::optional(Vertex{Next, node}) : std::nullopt;
  }

  std::optional<Vertex> of_next(Step& step) const {
    const std::uint32_t sibling = at(step.vertex.index).end;
    if (sibling >= at(at(step.vertex.index).parent).end || step.edge == 2) return std::nullopt;
    return Vertex{step.edge++ == 0 ? Begun : Next, sibling};
  }

  std::optional<Vertex> of_begun(Step& step) const {
    const std::uint32_t node = step.vertex.index;
    if (step.edge++ == 0) {
      if (const auto group = groups_.find(node); group != groups_.end()) {
        return Vertex{Group, group->second};
      }
    }
    if (step.child >= at(node).end) return std::nullopt;
    const std::uint32_t child = step.child;
    step.child = at(child).end;
    return Vertex{Begun, child};
  }

  std::vector<WaitingLink> circle() const {
    auto step = std::ranges::find(stack_, closed_at_, &Step::vertex);
    std::vector<Vertex> way;
    for (; step != stack_.end(); ++step) way.push_back(step->vertex);
    const auto is_group = [](const Vertex& vertex) { return vertex.kind == Group; };
    std::rotate(way.begin(), std::ranges::find_if(way, is_group), way.end());
    std::vector<WaitingLink> links;
    for (const Vertex& vertex : way) {
      if (is_group(vertex)) links.push_back({definition_.groups[vertex.index].node, 0, 0});
      if (vertex.kind == Next) links.back().sequence = at(vertex.index).parent;
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
      links[i].next = links[(i + 1) % links.size()].group;
    }
    return links;
  }

  const Definition& definition_;
  std::unordered_map<std::uint32_t, std::uint32_t> groups_;  // of each member that waits
  std::vector<State> states_;
  std::vector<Step> stack_;
  Vertex closed_at_{};
};

}  // namespace

std::vector<WaitingLink> waiting_circle(const Definition& definition) {
  return definition.groups.size() < 2 ? std::vector<WaitingLink>() : Search(definition).run();
}

}  // namespace lockstep::host
