#include "show/view/waiting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/progress.h"
#include "base/core/resource_set.h"
#include "base/core/synchronization.h"

namespace lockstep::host {
namespace {

// The names of some children: "a", "a and b", "a, b and 4 more".
template <class IsNamed>
std::string listed(const WaitedAt& node, IsNamed is_named) {
  constexpr std::size_t kNamed = 2;
  std::vector<std::string> names;
  std::size_t count = 0;
  for (std::size_t child = 0; child < node.progress.size(); ++child) {
    if (is_named(child) && ++count <= kNamed) names.push_back(node.name_of(child));
  }
  if (count == 0) return "";
  if (count == 1) return names[0];
  if (count == kNamed) return fmt::format("{} and {}", names[0], names[1]);
  return fmt::format("{}, {} and {} more", names[0], names[1], count - kNamed);
}

// While one of them cannot be relied on, all others are held, wherever they are.
std::string lost_text(const WaitedAt& node) {
  if (!node.lost) return "";
  for (std::size_t child = 0; child < node.progress.size(); ++child) {
    if (const std::string why = node.lost(child); !why.empty()) {
      return fmt::format("waits for {}: {}", node.name_of(child), why);
    }
  }
  return "";
}

// " (heard at 0.24, 0.02 s ago)", of the first of them that is a robot.
std::string heard_text(const WaitedAt& node, double most) {
  if (!node.heard) return "";
  for (std::size_t child = 0; child < node.progress.size(); ++child) {
    if (node.progress[child] > most) continue;
    if (const std::string heard = node.heard(child); !heard.empty()) return " (" + heard + ")";
  }
  return "";
}

}  // namespace

std::string waiting_text(const WaitedAt& node, std::size_t child) {
  if (std::string text = lost_text(node); !text.empty()) return text;
  const double least = least_progress(node.progress);
  const std::string whom = listed(node, [&](std::size_t it) {
    return node.progress[it] <= least + kProgressEpsilon;  // not one that is left out
  });
  const std::string of = node.group.empty() ? "" : fmt::format(" of '{}'", node.group);
  if (node.synchronization == Synchronization::Relative) {
    return fmt::format("waits for {}, {:.2f} ahead (delta {}{}){}", whom,
                       node.progress[child] - least, node.limit, of,
                       heard_text(node, least + kProgressEpsilon));
  }
  if (std::isinf(node.limit)) return fmt::format("waits for {}", whom);
  return fmt::format("waits for {} at barrier {:.6g}{}{}", whom, node.limit, of,
                     heard_text(node, least + kProgressEpsilon));
}

std::string beginning_text(const WaitedAt& node,
                           const std::function<bool(std::size_t child)>& is_reached) {
  const std::string whom =
      listed(node, [&](std::size_t it) { return node.progress[it] == 0 && !is_reached(it); });
  return fmt::format("waits to begin together with {}, of '{}'",
                     whom.empty() ? "the other members" : whom, node.group);
}

std::string ownership_text(const OwnedFrom& pool, std::size_t child) {
  const double limit = pool.limit(child);
  const ResourceSet owned = owned_set(limit);
  std::string text = owned == 0 ? "" : "owns " + to_text(owned, pool.resources);
  if (!waits(limit)) return text;
  const ResourceSet set = resource_set(limit) & ~owned;
  bool is_owned = false;
  std::string_view before = owned == 0 ? "waits for " : ", waits for ";
  for (std::size_t other = 0; other < pool.members; ++other) {
    const ResourceSet shared = set & owned_set(pool.limit(other));
    if (shared == 0) continue;
    text += fmt::format("{}{} ({})", std::exchange(before, ", "), to_text(shared, pool.resources),
                        pool.name_of(other));
    is_owned = true;
  }
  // Another robot has it, or it is only asked for.
  if (!is_owned && set != 0) text += fmt::format("{}{}", before, to_text(set, pool.resources));
  const std::string why = pool.why ? pool.why(child) : "";
  if (!why.empty()) text += ": " + why;
  return text;
}

}  // namespace lockstep::host
