// Which built-in nodes of the two languages mean the same.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lockstep {

// An attribute that must have this value; "" = none.
struct FixedAttribute {
  std::string_view name = {};
  std::string_view value = {};
  bool is_default = false;  // so it may be absent
};

struct NodePair {
  std::string_view theirs;
  std::string_view ours;
  FixedAttribute in_theirs = {};
  FixedAttribute in_ours = {};
  // A time in milliseconds there, and in seconds here; "" = none.
  std::string_view milliseconds = {};
};

std::span<const NodePair> node_pairs();

// "1500" as "1.5", and the other way round; "" if it is no number, or not one of milliseconds.
std::string seconds_of(std::string_view milliseconds);
std::string milliseconds_of(std::string_view seconds);

}  // namespace lockstep
