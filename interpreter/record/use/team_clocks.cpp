#include "record/use/team_clocks.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// The first tick of a wall clock in which a word is known may have begun a little before it came.
constexpr double kSlack = 0.001;
// Quartz clocks are better; and how close to the best drift the search comes.
constexpr double kMostDrift = 0.001;
constexpr int kSteps = 100;

// A word: at `time` of the robot, its clock and the other one differ by at most, or least, `bound`.
struct WordBound {
  double time = 0, bound = 0;
};

struct WordBounds {
  std::vector<WordBound> most, least;

  double most_with(double drift) const {
    double found = std::numeric_limits<double>::infinity();
    for (const WordBound& it : most) found = std::min(found, it.bound - drift * it.time);
    return found;
  }
  double least_with(double drift) const {
    double found = -std::numeric_limits<double>::infinity();
    for (const WordBound& it : least) found = std::max(found, it.bound - drift * it.time);
    return found;
  }
  double room(double drift) const { return most_with(drift) - least_with(drift); }
};

// The drift that leaves the most room, which is a concave function of it.
double best_drift(const WordBounds& bounds) {
  double low = -kMostDrift, high = kMostDrift;
  for (int i = 0; i < kSteps; ++i) {
    const double third = (high - low) / 3;
    const bool is_above = bounds.room(low + third) < bounds.room(high - third);
    is_above ? low += third : high -= third;
  }
  return (low + high) / 2;
}

std::string port_of(const ShapeNode& node, std::string_view name) {
  if (!node.ports) return "";
  const auto it = node.ports->find(name);
  return it == node.ports->end() ? "" : it->second;
}

}  // namespace

std::vector<Membership> memberships_of(const Shape& shape) {
  std::vector<Membership> all;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    const ShapeNode& it = shape.nodes[node];
    if (!is_robot(shape, node)) continue;
    const std::string team = port_of(it, "team"), self = port_of(it, "as");
    if (all.empty() || all.back().team != team) all.push_back({team, self, {}});
    all.back().others.push_back(node);
  }
  for (const ShapeNode& pool : shape.nodes) {
    if (pool.synchronization != Synchronization::Resources) continue;
    for (const NodeIndex child : pool.members) {
      const auto asker = asker_of(shape, child - 1);
      if (!asker) continue;
      const std::string team = port_of(shape.nodes[*asker], "team");
      if (std::ranges::find(all, team, &Membership::team) == all.end())
        all.push_back({team, port_of(shape.nodes[*asker], "as"), {}});
    }
  }
  return all;
}

void TeamWords::add(const RecordedTick& tick) {
  ticks.push_back({tick.tick - first_tick, tick.time});
  for (const RecordedHeard& it : tick.heard) heard.push_back({it.run, it.word, tick.time});
}

std::optional<double> TeamWords::sent(std::uint64_t word) const {
  const auto after =
      std::ranges::lower_bound(ticks, word, {}, [](const Tick& it) { return it.tick; });
  if (after == ticks.begin()) return std::nullopt;
  return (after - 1)->time;
}

ClockBounds clock_bounds(const TeamWords& other, const ClockFit& others, const TeamWords& robot) {
  const auto on_time = [&](double time) { return others.began + (1 + others.drift) * time; };
  WordBounds bounds;
  for (const TeamWords::Word& it : other.heard) {
    if (it.run != robot.run) continue;
    const auto sent = robot.sent(it.word);
    if (sent) bounds.most.push_back({*sent, on_time(it.time) - *sent});
  }
  for (const TeamWords::Word& it : robot.heard) {
    if (it.run != other.run) continue;
    const auto sent = other.sent(it.word);
    if (sent) bounds.least.push_back({it.time, on_time(*sent) - it.time});
  }
  for (WordBound& it : bounds.most) it.bound += other.is_real ? kSlack : 0;
  for (WordBound& it : bounds.least) it.bound -= robot.is_real ? kSlack : 0;
  const bool needs_drift = !bounds.most.empty() && !bounds.least.empty() && bounds.room(0) < 0;
  const double drift = needs_drift ? best_drift(bounds) : 0;
  return {.least = bounds.least_with(drift), .most = bounds.most_with(drift), .drift = drift};
}

}  // namespace lockstep::host
