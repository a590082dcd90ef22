// Sets of resources, as bits: the names of a pool are numbered when a tree is loaded.
#pragma once

#include <array>
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
// The most of a pool whose members may wait for one set while they own another: both fit. In a
// larger pool none exchanges, or takes over from the one before it.
inline constexpr std::size_t kMaxExchanged = 26;
// The most nodes of a tree that use a pool which robots share.
inline constexpr std::size_t kMostAsked = 8;

// The limit of a member of a pool, in the engine and in recordings, is the set that it owns in a
// tick; negative: the set that it waits for; 0: neither. One that waits for a set while it owns
// another has both: above the set that it waits for is the one that it owns, and above that a mark.
inline constexpr ResourceSet kOwnsAndWaits = ResourceSet{1} << (2 * kMaxExchanged);
inline bool waits(double limit) {
  return limit < 0;
}
inline bool owns(double limit) {
  return limit > 0;
}
inline double limit_of_waiting(ResourceSet wanted, ResourceSet owned) {
  const ResourceSet both = owned == 0 ? wanted : kOwnsAndWaits | owned << kMaxExchanged | wanted;
  return -static_cast<double>(both);
}
// The set that it waits for, or owns.
inline ResourceSet resource_set(double limit) {
  const auto set = static_cast<ResourceSet>(std::fabs(limit));
  return set < kOwnsAndWaits ? set : set & ((ResourceSet{1} << kMaxExchanged) - 1);
}
// The set that it owns, also while it waits for another one.
inline ResourceSet owned_set(double limit) {
  if (!waits(limit)) return resource_set(limit);
  const auto set = static_cast<ResourceSet>(std::fabs(limit));
  return set < kOwnsAndWaits ? 0 : (set ^ kOwnsAndWaits) >> kMaxExchanged;
}

// Takes the names off a list as it is written in a tree, "dock; any(left; right)": separated by ;
// or , or blanks.
class ResourceNames {
 public:
  explicit ResourceNames(std::string_view list) : rest_(list) {}

  // "" at the end.
  std::string_view next();
  // Whether the last name is one of any(…), of which one is enough.
  bool is_choice() const { return is_choice_; }
  // How many any( have begun, and whether the last one lacks its end.
  unsigned choices() const { return choices_; }
  bool is_open() const { return is_choice_; }

 private:
  std::string_view rest_;
  bool is_choice_ = false;
  unsigned choices_ = 0;
};
std::vector<std::string_view> resource_names(std::string_view list);

// What a list asks for: all of the first set, and if there are more, one of those. Each is a whole
// number in a double, as parameters have lists. Or the first name that is not one of `names`. Does
// not allocate.
struct ResourceList {
  std::array<double, kMaxResources + 1> sets{};
  std::size_t count = 1;
  std::string_view unknown = {};

  std::span<const double> request() const { return {sets.data(), count}; }
};
ResourceList resource_list(std::string_view list, std::span<const std::string> names);
// All that it names.
ResourceSet all_resources(std::span<const double> request);

// "left;gripper".
std::string to_text(ResourceSet set, std::span<const std::string> names);
// The same in the memory of `text`.
void to_text(ResourceSet set, std::span<const std::string> names, std::string& text);
// Whether that is the text. Does not allocate.
bool is_text_of(std::string_view text, ResourceSet set, std::span<const std::string> names);

}  // namespace lockstep::host
