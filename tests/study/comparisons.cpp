#include "study/comparisons.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "support/program.h"

namespace lockstep::host::test {

std::size_t Comparisons::cell_of(const Words& row) const {
  const auto axes = static_cast<std::ptrdiff_t>(summary_.at("node"));
  const auto values = [&](const Words& of) { return Words(of.begin(), of.begin() + axes); };
  std::set<Words> before;  // the summary has the cells in their order
  for (const Words& it : summary_.rows) {
    if (values(it) == values(row)) break;
    before.insert(values(it));
  }
  return before.size();
}

nlohmann::json Comparisons::between(const Words& from, const Words& to) {
  const std::pair cells{cell_of(from), cell_of(to)};
  auto& measures = made_[cells];
  if (measures.is_null()) {
    const Outcome outcome =
        run_lockstep({"study", "compare", directory_, "--json", "--cells",
                      std::to_string(cells.first), std::to_string(cells.second)});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    measures = parse_json(outcome.out)["measures"];
  }
  const auto found = std::ranges::find_if(measures, [&](const nlohmann::json& it) {
    return it["node"] == from.at(summary_.at("node")) &&
           it["measure"] == from.at(summary_.at("measure"));
  });
  REQUIRE(found != measures.end());
  return *found;
}

std::string on_side(const std::string& text, Side side) {
  static const std::regex both("([^= ]+) ?→ ?([^ ]+)");
  return std::regex_replace(text, both, side == Side::From ? "$1" : "$2");
}

}  // namespace lockstep::host::test
