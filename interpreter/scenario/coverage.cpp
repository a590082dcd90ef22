#include "scenario/coverage.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <thread>

#include "scenario/possible.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostNames = 5;

std::size_t count(const AspectSet& set) {
  return static_cast<std::size_t>(std::popcount(set.bits));
}

}  // namespace

std::size_t CoveredNode::all() const {
  return count(possible) + barriers.size();
}

std::size_t CoveredNode::shown() const {
  const auto waited = std::ranges::count_if(barriers, [](const auto& it) { return it.second; });
  return count(seen) + static_cast<std::size_t>(waited);
}

std::size_t CoveredTree::all() const {
  return std::transform_reduce(nodes.begin(), nodes.end(), std::size_t{0}, std::plus<>(),
                               [](const CoveredNode& it) { return it.all(); });
}

std::size_t CoveredTree::shown() const {
  return std::transform_reduce(nodes.begin(), nodes.end(), std::size_t{0}, std::plus<>(),
                               [](const CoveredNode& it) { return it.shown(); });
}

void Coverage::add(const ScenarioReport& report) {
  const auto& fixture = report.fixture;
  const NodeCoverage& coverage = *report.coverage;
  auto it = std::ranges::find(fixtures_, fixture, &Played::fixture);
  if (it == fixtures_.end()) {
    fixtures_.push_back({fixture, report.leaves, report.rate, NodeCoverage(fixture->tree()), {}});
    it = fixtures_.end() - 1;
  }
  Played& played = *it;
  played.coverage.add(coverage);
  for (NodeIndex node = 0; node < fixture->tree().nodes[0].end; ++node) {
    auto& by = played.by[node];
    for (std::size_t aspect = 0; aspect < kAspectCount; ++aspect) {
      const bool is_shown = coverage.seen(node).has(static_cast<Aspect>(aspect));
      if (is_shown && by[aspect].size() < kMostNames) by[aspect].push_back(report.scenario->name);
    }
  }
}

void Coverage::find_possible(unsigned jobs) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < fixtures_.size(); i = next++) {
      Played& it = fixtures_[i];
      const auto found = possible_coverage(it.fixture->tree(), it.leaves, it.rate);
      if (found) it.possible.emplace(*found);
    }
  };
  std::vector<std::jthread> threads;
  const auto count = std::min<std::size_t>(jobs, fixtures_.size());
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back(work);
}

std::vector<CoveredTree> Coverage::trees(unsigned jobs) {
  find_possible(jobs);
  struct Numbered {
    CoveredTree tree;
    std::map<std::string, std::size_t> numbers;  // of the nodes, by path
  };
  std::vector<Numbered> all;
  for (const Played& played : fixtures_) {
    const Fixture& fixture = *played.fixture;
    auto it = std::ranges::find_if(all, [&](const Numbered& known) {
      return known.tree.file == fixture.file() && known.tree.id == fixture.tree().id;
    });
    if (it == all.end()) {
      all.push_back({{.file = fixture.file(), .id = fixture.tree().id}, {}});
      it = all.end() - 1;
    }
    merge(played, it->tree, it->numbers);
  }
  std::vector<CoveredTree> trees;
  for (Numbered& it : all) trees.push_back(std::move(it.tree));
  return trees;
}

void Coverage::merge(const Played& played, CoveredTree& into,
                     std::map<std::string, std::size_t>& numbers) const {
  const Fixture& fixture = *played.fixture;
  const Tree& tree = fixture.tree();
  const auto& possible = played.possible;
  into.is_proved &= possible.has_value();
  for (NodeIndex index = 0; index < tree.nodes.size(); ++index) {
    const auto waited = played.coverage.barriers().find(index);
    const bool has_barriers = waited != played.coverage.barriers().end();
    if (tree.is_group(index) && !has_barriers) continue;
    const auto [it, is_new] = numbers.try_emplace(tree.path(index), into.nodes.size());
    if (is_new) {
      into.nodes.push_back({.path = tree.path(index),
                            .kind = std::string(tree.labels[index].type->id),
                            .place = fixture.location_of(index),
                            .seen = {},
                            .possible = {}});
    }
    CoveredNode& node = into.nodes[it->second];
    node.ticks += played.coverage.ticks(index);
    node.seen.bits |= played.coverage.seen(index).bits;
    if (!tree.is_group(index)) {
      node.possible.bits |= possible ? possible->seen(index).bits : usual_aspects(tree, index).bits;
    }
    node.possible.bits |= node.seen.bits;
    if (has_barriers) {
      for (const auto& [barrier, is_reached] : waited->second) {
        const bool can_be = !possible || possible->barriers().at(index).at(barrier);
        if (!can_be && !is_reached) continue;
        bool& known = node.barriers[barrier];
        known |= is_reached;
      }
    }
    if (const auto by = played.by.find(index); by != played.by.end()) {
      for (std::size_t aspect = 0; aspect < kAspectCount; ++aspect) {
        auto& names = node.by[aspect];
        names.insert(names.end(), by->second[aspect].begin(), by->second[aspect].end());
        if (names.size() > kMostNames) names.resize(kMostNames);
      }
    }
  }
}

double percent(std::span<const CoveredTree> trees) {
  std::size_t all = 0, shown = 0;
  for (const CoveredTree& it : trees) {
    all += it.all();
    shown += it.shown();
  }
  return all == 0 ? 100 : 100 * static_cast<double>(shown) / static_cast<double>(all);
}

}  // namespace lockstep::host
