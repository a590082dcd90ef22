// What `lockstep study compare` finds between two cells of a study, for the tables of a page.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "study/choice.h"
#include "support/json.h"

namespace lockstep::host::test {

class Comparisons {
 public:
  Comparisons(std::string directory, const Summary& summary)
      : directory_(std::move(directory)), summary_(summary) {}

  // From the cell of one row of the summary to that of another: the measure of both.
  nlohmann::json between(const Words& from, const Words& to);

 private:
  std::size_t cell_of(const Words& row) const;

  std::string directory_;
  const Summary& summary_;
  std::map<std::pair<std::size_t, std::size_t>, nlohmann::json> made_;
};

// Words of a column or a label of a row that may have "noise=0→0.01": with its first value, or with
// its second one.
enum class Side : std::uint8_t { From, To };
std::string on_side(const std::string& text, Side side);

}  // namespace lockstep::host::test
