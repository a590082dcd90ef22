// The index of the ends of paths finds what a look at all paths does.
#include <catch2/catch.hpp>

#include "base/core/random.h"
#include "language/property/node_names.h"

namespace lockstep::host {
namespace {

TEST_CASE("the index of ends finds the one node that a look at all paths finds") {
  RandomStream random(1, 1);
  const auto below = [&](double count) {
    return static_cast<std::uint32_t>(random.next_double() * count);
  };
  const auto name = [&] { return std::string(1, static_cast<char>('a' + below(4))); };
  for (int round = 0; round < 200; ++round) {
    std::vector<std::string> paths{"M"};
    while (paths.size() < 30) paths.push_back(paths[below(double(paths.size()))] + '/' + name());
    const PathEnds ends(paths);
    for (int i = 0; i < 40; ++i) {
      std::string end = name();
      while (below(3) == 0) end = (below(4) == 0 ? "M" : name()) + '/' + end;
      const std::uint32_t first = below(10), last = first + 1 + below(20);
      INFO(end << " in " << first << " to " << last);
      const auto expected = find_node(end, std::span(paths).subspan(first, last - first));
      const auto found = ends.find(end, paths, first, last);
      CHECK(found.has_value() == expected.has_value());
      if (found && expected) CHECK(*found == first + *expected);
    }
  }
}

}  // namespace
}  // namespace lockstep::host
