#include "observers/waiting.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace lockstep {
namespace {

constexpr double kEqual = 1e-9;  // as the engine compares progress

// The names of the children with the least progress: "a", "a and b", "a, b and 4 more".
std::string slowest(const WaitedAt& node, std::span<const double> progress, double least) {
  constexpr std::size_t kNamed = 2;
  std::vector<std::string> names;
  std::size_t count = 0;
  for (std::size_t child = 0; child < progress.size(); ++child) {
    if (progress[child] > least + kEqual) continue;
    if (++count <= kNamed) names.push_back(node.name_of(child));
  }
  if (count == 1) return names[0];
  if (count == kNamed) return fmt::format("{} and {}", names[0], names[1]);
  return fmt::format("{}, {} and {} more", names[0], names[1], count - kNamed);
}

}  // namespace

std::string waiting_text(const WaitedAt& node, std::span<const double> progress,
                         std::size_t child) {
  const double least = *std::min_element(progress.begin(), progress.end());
  const std::string whom = slowest(node, progress, least);
  if (node.synchronization == Synchronization::Relative) {
    return fmt::format("waits for {}, {:.2f} ahead (delta {})", whom, progress[child] - least,
                       node.delta);
  }
  const auto next = std::upper_bound(node.barriers.begin(), node.barriers.end(), least + kEqual);
  if (next == node.barriers.end()) return fmt::format("waits for {}", whom);
  return fmt::format("waits for {} at barrier {:.6g}", whom, *next);
}

std::string waiting_text(const Tree& tree, NodeIndex node, std::span<const double> progress,
                         std::size_t child) {
  const auto kind = synchronization(tree.nodes[node]);
  const auto name_of = [&](std::size_t number) {
    NodeIndex index = node + 1;
    for (; number > 0; --number) index = tree.nodes[index].end;
    return tree.segment(index);
  };
  return waiting_text({.synchronization = kind,
                       .barriers = barriers(tree, node),
                       .delta = kind == Synchronization::Relative ? delta(tree, node) : 0,
                       .name_of = name_of},
                      progress, child);
}

std::string standstill_text(const Tree& tree, const Standstill& standstill) {
  return fmt::format(
      "{} stands still at {:.6g} since {:.3f} s and holds the other children of '{}' back",
      tree.path(standstill.child), standstill.progress, to_seconds(standstill.since),
      tree.segment(standstill.node));
}

}  // namespace lockstep
