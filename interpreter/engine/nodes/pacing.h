// The law of pacing. A child gets the factor "its time to the limit, divided by the longest such
// time", so the one that needs the longest is never slowed. Rates are learned from the progress: a
// child that is at 0.3 after what counts as 2 s at full speed makes 0.15 a second. Whoever is held
// is held by its progress alone, so a leaf that does not obey breaks nothing.
//
// Example: delta 0.2, one child at 0.1 and one at 0.3, which make 1 and 3 a second. The limit is
// 0.3: the first needs 0.2 s, the second nothing, so the second gets the least factor.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/core/progress.h"
#include "engine/node_context.h"
#include "engine/pace.h"

namespace lockstep::host::pacing {

inline constexpr Parameter kPace{
    .name = "pace",
    .type = ValueType::Bool,
    .doc =
        "Slow down the children that are ahead, so that all arrive together, instead of only "
        "holding them.",
    .default_text = "false",
    .constant = true};
inline constexpr Parameter kReaction{
    .name = "reaction",
    .type = ValueType::Double,
    .doc =
        "With pace: the time that a robot needs to reach a new speed, and its progress to "
        "show it; 1 when absent.",
    .unit = "s",
    .range = {.min = 0, .max = kMostReaction},
    .constant = true};

// `pace` is the place of the first of the two parameters. Where pace="${pace}" is an argument that
// a study sets to false, the reaction may stay.
inline std::optional<RuleBreak> check(const ParameterValues& given, unsigned pace) {
  const bool paces = given.values[pace] == Value(true);
  if (!given.is_given(pace + 1)) {
    if (paces) given.values[pace + 1] = 1.0;
    return std::nullopt;
  }
  if (given.is_given(pace)) return std::nullopt;
  return RuleBreak{static_cast<int>(pace + 1), "'reaction' is given, but the node does not pace",
                   "add pace=\"true\", or remove 'reaction'"};
}

// What a child was told stays until a change of this share.
inline constexpr double kLeastChange = 0.05;

// A child as the snapshot of the tick has it.
struct Child {
  NodeIndex node;
  double reached;
  bool is_in;       // it runs, and is neither a guard nor complete
  bool was_ticked;  // in the last tick of the node
  bool is_held;     // in this tick
};

struct Tick {
  double limit;     // infinity: there is none
  double reaction;  // s
  double given;     // to the node, in its last tick
  double seconds;   // since then
};

// The least that running leaves of the subtree took up of what was asked of them, with what nodes
// within the subtree asked taken away; infinity: none runs.
double taken_up(NodeContext& context, NodeIndex node);

// How fast the child was, of what it is alone, and what that says of its rate. What counts falls
// slowly: a robot that was told to be slower is not yet, and its progress would say that it is
// fast.
inline void learn(NodeContext& context, const Child& child, PacedChild& own, const Tick& tick) {
  if (!child.is_in) {
    own = {};
    return;
  }
  if (child.was_ticked) {
    const double took = std::min(1.0, taken_up(context, child.node) / factor_of(tick.given));
    const double least = tick.reaction > 0 ? own.counts - tick.seconds / tick.reaction : 0.0;
    own.counts = std::max(took, least);
    own.at_full += own.counts * tick.seconds;
  }
  const double way = child.reached - own.begun;
  own.rate = own.at_full > 0 && way > kProgressEpsilon ? way / own.at_full : 0.0;
}

// Finds PacedChild::told, ::asked and ::given. `each(visit)` visits the children, save guards, with
// what is kept of them. `asks`: the node asks for something in this tick. A child that is held
// keeps what it was told.
template <class Each>
void set_factors(NodeContext& context, const Tick& tick, double given, bool asks, Each each) {
  double least_rate = std::numeric_limits<double>::infinity();
  each([&](const Child& child, PacedChild& own) {
    learn(context, child, own, tick);
    if (own.rate > 0) least_rate = std::min(least_rate, own.rate);
  });
  const auto way_to_limit = [&](const Child& child) {
    return std::max(0.0, tick.limit - child.reached);
  };
  const double beyond = tick.reaction * least_rate;
  double longest = 0, longest_beyond = 0;
  each([&](const Child& child, PacedChild& own) {
    if (own.rate == 0) return;
    longest = std::max(longest, way_to_limit(child) / own.rate);
    longest_beyond = std::max(longest_beyond, (way_to_limit(child) + beyond) / own.rate);
  });
  const auto share = [](double time, double of) {
    return of <= kProgressEpsilon ? 0.0 : time / of;
  };
  each([&](const Child& child, PacedChild& own) {
    if (child.is_held) return;
    double factor = 1.0;
    if (asks && own.rate != 0) {
      factor = std::max(share(way_to_limit(child) / own.rate, longest),
                        share((way_to_limit(child) + beyond) / own.rate, longest_beyond));
      factor = std::max(factor, kLeastFactor);
    }
    if (factor == 1.0 || std::abs(factor - own.told) >= kLeastChange * own.told) own.told = factor;
    own.asked = asks ? own.told : kNoPace;
    own.given = multiplied(given, own.asked);
  });
}

}  // namespace lockstep::host::pacing
