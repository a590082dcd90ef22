#include "judge/summary/standstill_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/core/progress.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// A member is called by its name, and if it has none, by its child.
std::string path_of(const Shape& shape, const WaitLink& link, NodeIndex node) {
  const ShapeNode& it = shape.nodes[node];
  const bool is_nameless = shape.nodes[link.node].is_group() && it.name == it.kind;
  return shape.nodes[is_nameless ? node + 1 : node].path;
}

class StandstillText {
 public:
  StandstillText(const Shape& shape, const Standstill& standstill)
      : shape_(shape), standstill_(standstill), links_(standstill.chain.links) {
    std::map<std::string, std::string> paths;
    for (const WaitLink& link : links_) {
      paths[shape.nodes[link.node].path];
      paths[path_of(shape, link, link.waiting)];
      paths[path_of(shape, link, link.awaited)];
    }
    std::vector<std::string> all;
    for (const auto& [path, name] : paths) all.push_back(path);
    const std::vector<std::string> names = names_of(all);
    for (std::size_t i = 0; i < all.size(); ++i) names_[all[i]] = names[i];
  }

  std::vector<std::string> lines() const {
    std::vector<std::string> lines{standstill_.is_circle() ? circle() : child()};
    // The head of a chain is the first line, and so is a pool at its end.
    const auto is_said = [&](std::size_t place) {
      return place == standstill_.head || (place > standstill_.head && is_last());
    };
    for (std::size_t place = 0; place < links_.size(); ++place) {
      if (standstill_.is_circle() || !is_said(place)) lines.push_back(link(place));
    }
    return lines;
  }

  std::vector<std::string> links() const {
    std::vector<std::string> lines;
    for (std::size_t place = 0; place < links_.size(); ++place) lines.push_back(link(place));
    return lines;
  }

 private:
  std::string circle() const {
    std::vector<std::string> names;
    for (const WaitLink& link : links_) names.push_back(name(link.node));
    names.push_back(names.front());
    return fmt::format("a deadlock since {:.3f} s: {}", to_seconds(standstill_.since),
                       chained(std::vector<std::string_view>(names.begin(), names.end())));
  }

  // The child that the head waits for.
  std::string child() const {
    const WaitLink& head = standstill_.link();
    const bool is_group = shape_.nodes[head.node].is_group();
    const std::string who = shape_.nodes[is_group ? head.awaited + 1 : head.awaited].path;
    const std::string others =
        fmt::format("the other {} of '{}'", is_group ? "members" : "children", name(head.node));
    const double since = to_seconds(standstill_.since);
    const std::string wait = fmt::format("and {} wait for it since {:.3f} s", others, since);
    const std::string hold = fmt::format("since {:.3f} s and holds {} back", since, others);
    switch (is_last() ? standstill_.chain.obstacle : Obstacle::Running) {
      case Obstacle::Idle:
        return fmt::format("{} does not run, {}", who, wait);
      case Obstacle::Failed:
        return fmt::format("{} has failed, {}", who, wait);
      case Obstacle::Denied:
        return fmt::format("{} waits for {}, {}", who, denied(), wait);
      case Obstacle::Running:
      case Obstacle::Circle:
        break;
    }
    if (head.awaited_at >= standstill_.best - kProgressEpsilon) {
      return fmt::format("{} makes no progress at {:.6g} {}", who, head.awaited_at, hold);
    }
    return fmt::format(
        "{} moves, but is at {:.6g} and has not come beyond {:.6g} since {:.3f} s, "
        "and holds {} back",
        who, head.awaited_at, standstill_.best, since, others);
  }

  // The obstacle is of the last link, behind which there may only be one of a pool.
  bool is_last() const {
    return std::all_of(links_.begin() + static_cast<std::ptrdiff_t>(standstill_.head) + 1,
                       links_.end(),
                       [&](const WaitLink& it) { return shape_.nodes[it.node].is_pool(); });
  }

  std::string denied() const {
    const WaitLink& last = links_.back();
    return fmt::format("{}, which '{}' owns", resources(last), name_in(last, last.awaited));
  }

  std::string link(std::size_t place) const {
    const WaitLink& it = links_[place];
    const std::string what = name_in(it, it.awaited), who = name_in(it, it.waiting);
    if (shape_.nodes[it.node].is_pool()) {
      return fmt::format("'{}' keeps {} from '{}' until '{}' gives it back, which {}",
                         name(it.node), resources(it), who, what, state(place));
    }
    return fmt::format("'{}' holds '{}' at {:.6g} until '{}' comes, which {}", name(it.node), who,
                       it.waiting_at, what, state(place));
  }

  // The state of a node that a link waits for: how far it is, and where the next link holds
  // something.
  std::string state(std::size_t place) const {
    const WaitLink& it = links_[place];
    const std::string at = it.awaited_status == Status::Running
                               ? fmt::format("is at {:.6g}", it.awaited_at)
                           : it.awaited_status == Status::Failure ? "has failed"
                                                                  : "does not run";
    if (place + 1 == links_.size() && !standstill_.is_circle()) return at;
    const WaitLink& next = links_[(place + 1) % links_.size()];
    if (next.waiting == it.awaited || next.awaited == it.awaited) return at;
    const std::string inner = name_in(next, next.awaited);
    if (contains(it.awaited, next.awaited)) return fmt::format("{} and has '{}' in it", at, inner);
    const std::string other = name_in(next, next.waiting);
    if (contains(it.awaited, next.waiting)) return fmt::format("{} and has '{}' in it", at, other);
    if (contains(next.waiting, it.awaited))
      return fmt::format("{} and is inside of '{}'", at, other);
    return fmt::format("{} and comes after '{}'", at, other);
  }

  bool contains(NodeIndex node, NodeIndex other) const {
    return node <= other && other < shape_.nodes[node].end;
  }
  std::string resources(const WaitLink& link) const {
    return to_text(link.resources, shape_.nodes[link.node].resources);
  }
  std::string name(NodeIndex node) const { return names_.at(shape_.nodes[node].path); }
  std::string name_in(const WaitLink& link, NodeIndex node) const {
    return names_.at(path_of(shape_, link, node));
  }

  const Shape& shape_;
  const Standstill& standstill_;
  const std::vector<WaitLink>& links_;
  std::map<std::string, std::string> names_;  // of paths
};

}  // namespace

std::vector<std::string> standstill_lines(const Shape& shape, const Standstill& standstill) {
  return StandstillText(shape, standstill).lines();
}

std::vector<std::string> wait_lines(const Shape& shape, const WaitChain& chain) {
  const Standstill standstill{.chain = chain};
  return StandstillText(shape, standstill).links();
}

std::string_view to_string(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::Idle:
      return "idle";
    case Obstacle::Failed:
      return "failed";
    case Obstacle::Denied:
      return "resources";
    case Obstacle::Circle:
      return "circle";
    case Obstacle::Running:
      break;
  }
  return "running";
}

}  // namespace lockstep::host
