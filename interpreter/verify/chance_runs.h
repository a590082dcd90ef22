// Runs by chance beside a search: the tree is ticked from its beginning on, nothing is folded or
// restored in between, and its leaves answer as those of `lockstep run --leaves FILE --seed N`. The
// search must know each tick of them. So a proof that some run refutes is not told as one.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "verify/search.h"

namespace lockstep::host {

struct ChanceLimits {
  std::uint64_t runs = 300;
  Nanoseconds time = std::chrono::milliseconds(200);  // of a real clock
  std::function<int()> stop_signal = {};              // nonzero: stop
};
// These cost little beside the search.
ChanceLimits usual_chance(const SearchResult& found);

struct Contradiction {
  std::uint64_t seed = 0;
  std::string what;  // "in tick 3, 'T/a' is held; in the search, it is running"
};

// "internal error: a run contradicts this proof; the seed is 7: in tick 3, …"
std::string to_text(const Contradiction& contradiction);

// The ticks that the search has looked at with all behaviors.
std::optional<Contradiction> find_contradiction(const Tree& tree, const LeafModels& models,
                                                std::span<const Property> properties, double rate,
                                                const SearchResult& found,
                                                const ChanceLimits& limits);

}  // namespace lockstep::host
