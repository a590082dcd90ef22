// The built-in nodes of BehaviorTree.CPP, and some of Nav2, beside those of our language. This is
// the one table of how both are called, for `convert`, Groot2, hints, nodes-and-attributes.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockstep::host::btcpp {

// An attribute that must have this value; "" = none.
struct FixedAttribute {
  std::string_view name = {};
  std::string_view value = {};
  bool is_default = false;  // so it may be absent
  bool is_detail = false;   // a hint leaves it out
};

// How a value is converted.
enum class Conversions : unsigned char {
  None,           // it means the same
  Milliseconds,   // there, and seconds here
  Rounds,         // -1 there is for ever, and absent here
  Attempts,       // -1 there is for ever, which cannot be said here
  Children,       // -1 there is all, -2 all but one, …; here a number, and absent is all
  WithoutBraces,  // a {key} there, its name here
};

// The names of an attribute there and here.
struct AttributePair {
  std::string_view theirs;
  std::string_view ours;  // "": none
  Conversions conversion = Conversions::None;
};

// What may be seen of a node that makes it differ.
enum class When : unsigned char {
  Always,
  IsHeld,          // it is below a synchronized node
  ConditionRuns,   // its first child, for several ticks
  LeafMayRun,      // the same, if a leaf that nothing describes is an action
  FirstIsSkipped,  // its first child, by a script
  LeafSkipsFirst,  // its first child, if a leaf of a plugin returns Skipped
  FirstIsDecided,  // its first child has a success_if or failure_if
};

// What a node does there and here.
struct Difference {
  std::string_view what;
  When when = When::Always;
};

// The remark of the nodes of Nav2 that a plugin of lockstep has.
inline constexpr std::string_view kOfNav = "the plugin nav has it: add <plugin name=\"nav\"/>";

struct NodePair {
  std::string_view theirs;
  std::string_view ours = {};  // "": none
  FixedAttribute in_theirs = {};
  FixedAttribute in_ours = {};
  std::span<const AttributePair> attributes = {};  // that differ
  std::span<const AttributePair> words = {};       // more of them, for hints alone
  std::span<const Difference> differences = {};
  std::string_view remark = {};  // of a hint: what is different, or what to do instead
};

// Those that can be converted.
std::span<const NodePair> node_pairs();
// And those that have something like it at most.
std::span<const NodePair> similar_nodes();

enum class Side : bool { Theirs, Ours };

// The pair of a node of one of the languages; null if it cannot be said in the other one. `given`
// has the value of an attribute of the node, or nothing.
using GivenAttribute = std::function<std::optional<std::string_view>(std::string_view name)>;
const NodePair* find_pair(Side from, std::string_view type, const GivenAttribute& given);

// The value in the other language; "" if it is the same as none there. Nothing: it cannot be said.
// `children`: how many the node has.
std::optional<std::string> value_there(Conversions conversion, std::string_view ours);
std::optional<std::string> value_here(Conversions conversion, std::string_view theirs,
                                      std::uint32_t children);
// Which values can be said.
std::string_view hint_of(Conversions conversion);

}  // namespace lockstep::host::btcpp
