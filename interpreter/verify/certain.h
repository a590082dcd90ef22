// What is certain of a tree whatever its leaves do, as a complete search with the most general
// leaves has found it.
#pragma once

#include <span>
#include <vector>

#include "base/core/place.h"
#include "verify/advice.h"
#include "verify/search.h"

namespace lockstep::host {

// The results of the leaves of the search. Without Skipped, what is found is a note that says so.
enum class Results : std::uint8_t { All, NotSkipped };

// Nodes that no behavior ticks (of a subtree, only its root), and that no behavior ends. `places`
// are those of the nodes in their documents. `deadlocks`: a tree that never ends deadlocks in each
// run. `why_it_stands` explains a tree that stands still.
std::vector<Advice> certainties(const Tree& tree, std::span<const Place> places,
                                const SearchResult& found, Results results, bool deadlocks,
                                std::string why_it_stands);

}  // namespace lockstep::host
