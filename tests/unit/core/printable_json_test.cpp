#include "core/printable_json.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"

using namespace lockstep;
using nlohmann::json;

TEST_CASE("printable JSON holds nothing that a terminal obeys, and the same values") {
  const std::string text = "é 漢 \x1b[2J \x7f \u0085 \u009b \u200f \u202e \u2028 \u2069 \\ \" \n";
  const json value = {{text, {text, 1.5, nullptr}}, {"plain", text}};
  for (const int indent : {-1, 2}) {
    const std::string made = value.dump(indent);
    const std::string shown = printable_json(made);
    CHECK(json::parse(shown) == value);
    CHECK(shown.find("é 漢") != std::string::npos);
    std::string lines = shown;
    std::erase(lines, '\n');
    CHECK(printable(lines) == lines);
    CHECK(printable(made) != made);
  }
}
