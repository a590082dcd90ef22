// Sets of resources, as bits: the names of a pool are numbered when a tree is loaded.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

using ResourceSet = std::uint64_t;
// The most resources of a pool: a set fits into the whole numbers of a double, as which recordings
// have it.
inline constexpr std::size_t kMaxResources = 50;

// The limit of a member of a pool, in the engine and in recordings, is the set that it owns in a
// tick; negative: the set that it waits for; 0: neither.
inline bool waits(double limit) {
  return limit < 0;
}
inline bool owns(double limit) {
  return limit > 0;
}
// The set that it waits for, or owns.
inline ResourceSet resource_set(double limit) {
  return static_cast<ResourceSet>(std::fabs(limit));
}

// Takes the next name off a list as it is written in a tree, "left;gripper": separated by ; or , or
// blanks. "" at the end.
std::string_view take_resource(std::string_view& list);
std::vector<std::string_view> resource_names(std::string_view list);

// A list as a set of `names`, or the first name that is not one of these. Does not allocate.
struct ResourceList {
  ResourceSet set = 0;
  std::string_view unknown = {};
};
ResourceList resource_list(std::string_view list, std::span<const std::string> names);

// "left;gripper".
std::string to_text(ResourceSet set, std::span<const std::string> names);

}  // namespace lockstep::host
