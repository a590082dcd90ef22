#include "definition/xsd.h"

#include <catch2/catch.hpp>

namespace lockstep {
namespace {

const int kSomeLeaf = 0;

std::string schema_of(const Parameter& parameter, bool is_leaf) {
  const NodeType type{.id = "Thing",
                      .category = NodeCategory::Action,
                      .doc = "Turns <left> & \"right\".",
                      .arity = {0, 0},
                      .parameters = {&parameter, 1},
                      .binding = is_leaf ? &kSomeLeaf : nullptr};
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
                                        .unit = "m/s"},
                                       false);
  CHECK(has(schema, "Turns &lt;left&gt; &amp; &quot;right&quot;."));
  CHECK(has(schema, ">v &lt; c Unit: m/s. Default: '0.5'.<"));
}

TEST_CASE("required is what has no default") {
  Parameter speed{.name = "speed", .type = ValueType::Double, .doc = "", .required = true};
  CHECK(has(schema_of(speed, false), "name=\"speed\" use=\"required\""));
  speed.default_text = "1";
  CHECK(has(schema_of(speed, false), "name=\"speed\">"));
}

TEST_CASE("a parameter is fixed, an input may be a key, an output must be") {
  Parameter speed{.name = "speed", .type = ValueType::Double, .doc = ""};
  CHECK(has(schema_of(speed, false), "memberTypes=\"double substituted\""));
  CHECK(has(schema_of(speed, true), "memberTypes=\"double substituted key\""));
  for (const Direction direction : {Direction::Output, Direction::InOut}) {
    speed.direction = direction;
    CHECK(has(schema_of(speed, true), "memberTypes=\"substituted key\""));
  }
}

TEST_CASE("ranges and choices") {
  const std::string_view words[] = {"soft", "a<b"};
  CHECK(
      has(schema_of({.name = "grip", .type = ValueType::String, .doc = "", .choices = words}, true),
          "<xs:enumeration value=\"soft\"/><xs:enumeration value=\"a&lt;b\"/>"));
  CHECK(has(schema_of({.name = "n", .type = ValueType::Int, .doc = "", .range = {.min = 1}}, false),
            "base=\"int\"><xs:minInclusive value=\"1\"/></xs:restriction>"));
  CHECK(has(schema_of({.name = "x",
                       .type = ValueType::Double,
                       .doc = "",
                       .range = {.min = 0, .max = 1e9, .min_excluded = true}},
                      false),
            "<xs:minExclusive value=\"0\"/><xs:maxInclusive value=\"1000000000\"/>"));
}

}  // namespace
}  // namespace lockstep
