// What --grid may say: lists, ranges of exact decimals, and names whose values belong together.
#include "study/grid_text.h"

#include <catch2/catch.hpp>

namespace lockstep::host {
namespace {

using Texts = std::vector<std::string>;

Texts values(const std::string& text) {
  const auto axes = parse_grid(text);
  INFO(text);
  REQUIRE(axes.has_value());
  REQUIRE(axes->size() == 1);
  CHECK(axes->front().name == "a");
  CHECK_FALSE(axes->front().follows);
  return axes->front().values;
}

TEST_CASE("a grid's list is its values, whatever they are") {
  CHECK(values("a=1") == Texts{"1"});
  CHECK(values("a=0,0.50,x y") == Texts{"0", "0.50", "x y"});
  CHECK(values("a=1,,2") == Texts{"1", "", "2"});
  CHECK(values("a=b=c") == Texts{"b=c"});
  CHECK(values("a=0.25;0.5,0.75") == Texts{"0.25;0.5", "0.75"});
}

TEST_CASE("a grid's range is exact decimals, with both ends") {
  CHECK(values("a=0:1:0.1") ==
        Texts{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"});
  CHECK(values("a=1:0:-0.25") == Texts{"1", "0.75", "0.5", "0.25", "0"});
  CHECK(values("a=-0.02:.02:0.010") == Texts{"-0.02", "-0.01", "0", "0.01", "0.02"});
  CHECK(values("a=0:1:0.4") == Texts{"0", "0.4", "0.8"});
  CHECK(values("a=8:12:2") == Texts{"8", "10", "12"});
  CHECK(values("a=5:5:1") == Texts{"5"});
  CHECK(values("a=-0:0:1") == Texts{"0"});
  CHECK(values("a=1:100000:1").size() == kMostCells);
  CHECK(values("a=0:0.00000000002:0.00000000001").back() == "0.00000000002");
}

TEST_CASE("a grid's range is only what is three numbers and nothing else") {
  CHECK(values("a=10:20") == Texts{"10:20"});
  CHECK(values("a=1:2:3:4") == Texts{"1:2:3:4"});
  CHECK(values("a=10:20:30,10:20:40") == Texts{"10:20:30", "10:20:40"});
  CHECK(values("a=x:1:2") == Texts{"x:1:2"});
  CHECK(values("a=0:1:") == Texts{"0:1:"});
  CHECK(values("a=0:1:1e-1") == Texts{"0:1:1e-1"});
  CHECK(values("a=0:1:.") == Texts{"0:1:."});
}

TEST_CASE("a grid of several names has values together, never a range") {
  const auto axes = parse_grid("a,b,c=1:2:3,0:x;y:").value();
  REQUIRE(axes.size() == 3);
  CHECK(axes[0].values == Texts{"1", "0"});
  CHECK(axes[1].values == Texts{"2", "x;y"});
  CHECK(axes[2].values == Texts{"3", ""});
  CHECK_FALSE(axes[0].follows);
  CHECK(axes[1].follows);
  CHECK(axes[2].follows);
}

TEST_CASE("a grid that is none is refused") {
  const auto error = [](const std::string& text) {
    const auto axes = parse_grid(text);
    INFO(text);
    REQUIRE_FALSE(axes.has_value());
    return axes.error().message;
  };
  for (const char* text : {"", "a", "a=", "=1", ",a=1:2", "a,=1:2"})
    CHECK(error(text) == "--grid " + std::string(text) + ": expected name=value,value,…");
  CHECK(error("a=0:1:0.0") == "--grid a: the step of the range is 0");
  CHECK(error("a=1:0:0.1") == "--grid a: a step of 0.1 does not lead from 1 to 0");
  CHECK(error("a=0:100000:1") ==
        "--grid a: the range has 100001 values, at most 100000 are allowed");
  CHECK(error("a=0:9999999999999999:1") ==
        "--grid a: the numbers of the range have too many digits");
  CHECK(error("a=99999999999999:0:0.001") ==
        "--grid a: the numbers of the range have too many digits");
  CHECK(error("a,a=1:2") == "--grid a,a: a name is given twice");
  CHECK(error("a,b=1:2,3") == "--grid a,b: '3' has 1 of 2 values");
}

}  // namespace
}  // namespace lockstep::host
