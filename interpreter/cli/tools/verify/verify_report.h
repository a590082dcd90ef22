// A verdict as `lockstep verify` prints it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json/json.h"
#include "verify/costs.h"
#include "verify/counter_example.h"
#include "verify/verdict.h"

namespace lockstep::host {

struct VerifyReport {
  const SearchResult& found;
  const Verdict& verdict;
  std::string tree, leaves;  // files; "": there is no leaf file
  std::size_t leaf_count = 0;
  std::uint32_t cuts = 0;                            // at most, in a run
  std::span<const std::string> only = {};            // --only: other findings are left out
  std::map<std::string, CounterExample> files = {};  // of findings, by their names
  std::vector<SearchCost> costs = {};                // of a search that did not look at everything
  std::string internal_error = {};  // a run contradicts the search: nothing of it is told as true
};

// The name of a file about it, without an ending: "carry.property.grip" of "carry.property/grip".
std::string file_stem(std::string name);
// Why a search did not look at everything: "--states"; "" if it did.
std::string_view limit_of(SearchEnd end);
// "verified", "not verified: 2 findings", "bounded: nothing found in the first 23 ticks …",
// "internal error: …"; with --only, how many findings are left out.
std::string conclusion(const VerifyReport& report);
// A line for each, and how to begin a leaf model where there is none (`leaves` is "").
std::string to_text(const std::vector<SearchCost>& costs, const std::string& tree,
                    const std::string& leaves);
Json to_json(const std::vector<SearchCost>& costs);
// Of a search with this end.
bool wants_costs(SearchEnd end);
std::string to_text(const VerifyReport& report);
std::string to_json(const VerifyReport& report);
std::string to_junit(const VerifyReport& report);

}  // namespace lockstep::host
