#include "observers/waiting.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/synchronized.h"

namespace lockstep {
namespace {

constexpr double kEqual = 1e-9;  // as the engine compares progress

// The names of the children with the least progress: "a", "a and b", "a, b and 4 more".
std::string slowest(const Tree& tree, NodeIndex node, std::span<const double> progress,
                    double least) {
  constexpr std::size_t kNamed = 2;
  std::vector<std::string> names;
  NodeIndex child = node + 1;
  for (const double reached : progress) {
    if (reached <= least + kEqual) names.push_back(tree.segment(child));
    child = tree.nodes[child].end;
  }
  if (names.size() == 1) return names[0];
  if (names.size() == kNamed) return fmt::format("{} and {}", names[0], names[1]);
  return fmt::format("{}, {} and {} more", names[0], names[1], names.size() - kNamed);
}

}  // namespace

std::string waiting_text(const Tree& tree, NodeIndex node, std::span<const double> progress,
                         std::size_t child) {
  const double least = *std::min_element(progress.begin(), progress.end());
  const std::string whom = slowest(tree, node, progress, least);
  if (synchronization(tree.nodes[node]) == Synchronization::Relative) {
    return fmt::format("waits for {}, {:.2f} ahead (delta {})", whom, progress[child] - least,
                       delta(tree, node));
  }
  const auto list = barriers(tree, node);
  const auto next = std::upper_bound(list.begin(), list.end(), least + kEqual);
  if (next == list.end()) return fmt::format("waits for {}", whom);
  return fmt::format("waits for {} at barrier {:.6g}", whom, *next);
}

std::string standstill_text(const Tree& tree, const Standstill& standstill) {
  return fmt::format(
      "{} stands still at {:.6g} since {:.3f} s and holds the other children of '{}' back",
      tree.path(standstill.child), standstill.progress, to_seconds(standstill.since),
      tree.segment(standstill.node));
}

}  // namespace lockstep
