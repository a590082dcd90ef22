#include <catch2/catch.hpp>

#include "describe/node_reference.h"

namespace lockstep::host {

TEST_CASE("the facts of a parameter: its type, unit, limits and default") {
  Parameter it{.name = "speed", .type = ValueType::Double, .doc = "", .unit = "m/s"};
  CHECK(facts_text(it) == "double in m/s, optional");
  it.required = true;
  CHECK(facts_text(it) == "double in m/s, required");
  it.required = false;
  it.default_key = "speed";
  CHECK(facts_text(it) == "double in m/s, default {speed}");
  it.is_generic = true;
  it.unit = {};
  CHECK(facts_text(it) == "any type, default {speed}");
}

}  // namespace lockstep::host
