#include "kept_goal.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace ros2 {

static_assert(std::is_trivially_copyable_v<KeptGoal::Facts>);

std::size_t KeptGoal::write(void* bytes, std::size_t room) const {
  const std::size_t plain = sizeof facts + memory.size() * sizeof(double);
  const std::size_t size = plain + goal.size();
  if (size > room) return size;
  auto* to = static_cast<unsigned char*>(bytes);
  std::memcpy(to, &facts, sizeof facts);
  to += sizeof facts;
  for (const auto& first : memory) {
    const double value = first.value_or(std::nan(""));
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
  }
  std::memcpy(to, goal.data(), goal.size());
  return size;
}

std::optional<KeptGoal> read_kept_goal(std::string_view bytes, std::size_t firsts) {
  KeptGoal kept;
  if (bytes.size() < sizeof kept.facts + firsts * sizeof(double)) return std::nullopt;
  std::memcpy(&kept.facts, bytes.data(), sizeof kept.facts);
  bytes.remove_prefix(sizeof kept.facts);
  for (std::size_t i = 0; i < firsts; ++i) {
    double value = 0;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    kept.memory.push_back(std::isnan(value) ? std::nullopt : std::optional(value));
  }
  kept.goal = bytes;
  return kept;
}

}  // namespace ros2
