// The lines that leaves log, on their way to a recording or a view.
#include "run/leaf_lines.h"

#include <catch2/catch.hpp>

namespace lockstep::host::test {

TEST_CASE("logs: lines wait until a line of the file has them, what has no room is counted") {
  LeafLines lines;
  CHECK(lines.lines().empty());
  lines.add("Main/arm", "info", "begins");
  CHECK(lines.lines().size() == 1);
  lines.add("Main/base", "warning", "slips");
  REQUIRE(lines.lines().size() == 2);
  CHECK(lines.lines()[1] == LeafLine{"Main/base", "warning", "slips"});
  lines.keep();
  CHECK(lines.lines().empty());
  const std::string long_line(LeafLines::kRoom / 2, 'x');
  for (int i = 0; i < 4; ++i) lines.add("Main/arm", "debug", long_line);
  CHECK(lines.lines().size() == 1);
  CHECK(lines.left_out() == 3);
  lines.keep();
  lines.add("Main/arm", "debug", long_line);  // there is room again
  CHECK(lines.lines().size() == 1);
}

}  // namespace lockstep::host::test
