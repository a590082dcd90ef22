#include "describe/xsd.h"

#include <catch2/catch.hpp>

namespace lockstep::host {
namespace {

std::string schema_of(const Parameter& parameter) {
  const NodeType type{.id = "Thing",
                      .category = NodeCategory::Action,
                      .doc = "Turns <left> & \"right\".",
                      .arity = {0, 0},
                      .parameters = {&parameter, 1}};
  const NodeType* const types[] = {&type};
  return make_xsd(types);
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("documentation is text, with default and unit") {
  const std::string schema = schema_of({.name = "speed",
                                        .type = ValueType::Double,
                                        .doc = "v < c",
                                        .default_text = "0.5",
                                        .unit = "m/s"});
  CHECK(has(schema, "Turns &lt;left&gt; &amp; &quot;right&quot;."));
  CHECK(has(schema, ">v &lt; c Unit: m/s. Default: '0.5'.<"));
}

TEST_CASE("required is what has no default") {
  Parameter speed{.name = "speed", .type = ValueType::Double, .doc = "", .required = true};
  CHECK(has(schema_of(speed), "name=\"speed\" use=\"required\""));
  speed.default_text = "1";
  CHECK(has(schema_of(speed), "name=\"speed\">"));
}

TEST_CASE("an input may be a key unless it shapes the tree, an output must be") {
  Parameter speed{.name = "speed", .type = ValueType::Double, .doc = ""};
  CHECK(has(schema_of(speed), "memberTypes=\"double substituted key\""));
  speed.constant = true;
  CHECK(has(schema_of(speed), "memberTypes=\"double substituted\""));
  for (const Direction direction : {Direction::Output, Direction::InOut}) {
    speed.direction = direction;
    CHECK(has(schema_of(speed), "memberTypes=\"substituted key\""));
  }
}

TEST_CASE("ranges and choices") {
  const std::string_view words[] = {"soft", "a<b"};
  CHECK(has(schema_of({.name = "grip", .type = ValueType::String, .doc = "", .choices = words}),
            "<xs:enumeration value=\"soft\"/><xs:enumeration value=\"a&lt;b\"/>"));
  CHECK(has(schema_of({.name = "n", .type = ValueType::Int, .doc = "", .range = {.min = 1}}),
            "base=\"int\"><xs:minInclusive value=\"1\"/></xs:restriction>"));
  CHECK(has(schema_of({.name = "x",
                       .type = ValueType::Double,
                       .doc = "",
                       .range = {.min = 0, .max = 1e9, .min_excluded = true}}),
            "<xs:minExclusive value=\"0\"/><xs:maxInclusive value=\"1000000000\"/>"));
}

}  // namespace
}  // namespace lockstep::host
