// JSON as it is written, compared with what nlohmann's library makes of the same values.
#include "base/json/json.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/core/diagnostics.h"

using namespace lockstep::host;
using Other = nlohmann::ordered_json;

namespace {

// Texts are looked at eight letters at a time.
TEST_CASE("each letter is escaped as nlohmann's library does it, wherever it stands") {
  for (int letter = 1; letter < 256; ++letter) {
    for (std::size_t length = 1; length < 20; ++length) {
      for (std::size_t place = 0; place < length; ++place) {
        std::string text(length, 'a');
        text[place] = static_cast<char>(letter);
        std::string json;
        append_json(json, text);
        const auto expected = Other(text).dump(-1, ' ', false, Other::error_handler_t::replace);
        if (json != expected) FAIL_CHECK(letter << " at " << place << " of " << length);
      }
    }
  }
}

TEST_CASE("a number is written as nlohmann's library does it") {
  for (const double number : {0.0, -0.0, 1.0, -1.0, 0.5, 1e-7, 1e300, 0.1 + 0.2}) {
    std::string json;
    append_json(json, number);
    CHECK(json == Other(number).dump());
  }
}

const std::string kOdd = "é 漢 \x1b[2J \x7f \u0085 \u009b \u200f \u202e \u2028 \u2069 \\ \" \n";

Json value() {
  Json json{
      {"text", kOdd},
      {"numbers", Json::array({1, -2, 1.5, 1.0, 1e300, 18446744073709551615U, true, nullptr})},
      {"list", std::vector<double>{0.1, 3}},
      {"none", std::optional<int>()},
      {"object", {{"a", 1}, {"b", Json::object()}}},
      {"nan", std::numeric_limits<double>::quiet_NaN()}};
  json["empty"] = Json::array();
  json["empty"].push_back({{"x", "y"}});
  json["empty"].back()["z"] = "\xff";
  return json;
}

Other other() {
  return {{"text", kOdd},
          {"numbers", {1, -2, 1.5, 1.0, 1e300, 18446744073709551615U, true, nullptr}},
          {"list", {0.1, 3.0}},
          {"none", nullptr},
          {"object", {{"a", 1}, {"b", Other::object()}}},
          {"nan", nullptr},
          {"empty", {{{"x", "y"}, {"z", "\xff"}}}}};
}

}  // namespace

TEST_CASE("JSON is written as nlohmann's library writes it") {
  CHECK(value().text() == other().dump(-1, ' ', false, Other::error_handler_t::replace));
  CHECK(value().text(2) == other().dump(2, ' ', false, Other::error_handler_t::replace));
}

TEST_CASE("printable JSON holds nothing that a terminal obeys, and the same values") {
  for (const std::size_t indent : {0, 2}) {
    const std::string made = value().text(indent);
    const std::string shown = value().printable(indent);
    CHECK(Other::parse(shown) == Other::parse(made));
    CHECK(shown.find("é 漢") != std::string::npos);
    std::string lines = shown;
    std::erase(lines, '\n');
    CHECK(printable(lines) == lines);
    CHECK(printable(made) != made);
  }
}
