#include "base/json/reader.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace lockstep::host {
namespace {

// "" or why the object is refused when these fields are read from it.
std::string error_of(std::string text, std::initializer_list<JsonField> fields = {}) {
  JsonReader reader;
  const std::string before = text;
  try {
    reader.read(text, [&](JsonObject object) { object.read(fields); });
  } catch (const JsonError& error) {
    CHECK(text == before);
    return error.what();
  }
  CHECK(text == before);
  return {};
}

template <class Value>
Value value_of(const std::string& text) {
  Value value{};
  CHECK(error_of("{\"a\":" + text + "}", {{"a", into(value)}}) == "");
  return value;
}

// A random object, as deep as `levels`.
std::string random_json(std::mt19937& random, int levels) {
  constexpr const char* kScalars[] = {"0",    "-1",   "1.5e3", "true",    "false",
                                      "null", "\"\"", "\"é\"", "\"\\n\"", "\"\\u0041\""};
  if (levels == 0) return kScalars[random() % std::size(kScalars)];
  const bool is_list = random() % 2 == 0;
  std::string text = is_list ? "[" : "{";
  for (auto count = random() % 4; count > 0; --count) {
    if (!is_list) text += "\"k\" :";
    text += random_json(random, static_cast<int>(random() % static_cast<unsigned>(levels)));
    if (count > 1) text += ", ";
  }
  return text + (is_list ? "]" : "}");
}

}  // namespace

TEST_CASE("values are read exactly") {
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  CHECK(value_of<std::uint64_t>("0") == 0);
  CHECK(value_of<std::uint64_t>("18446744073709551615") == kMost);
  CHECK(value_of<double>("0.1") == 0.1);
  CHECK(value_of<double>("0.30000000000000004") == 0.1 + 0.2);
  CHECK(value_of<double>("5e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(value_of<double>("1.7976931348623157e308") == std::numeric_limits<double>::max());
  CHECK(std::signbit(value_of<double>("-0")));
  CHECK(value_of<std::string>(R"("\"\\\/\b\f\n\r\t\u0000\u00e9\ud83e\udd16")") ==
        std::string("\"\\/\b\f\n\r\t\0\xc3\xa9\xf0\x9f\xa4\x96", 15));
}

TEST_CASE("a value of another kind, or out of range, is named") {
  std::uint64_t whole = 0;
  double number = 0;
  std::string text;
  for (const char* wrong : {"18446744073709551616", "99999999999999999999999", "-1", "-0", "1.0",
                            "1e3", "\"1\"", "true", "null", "[1]", "{}"}) {
    INFO(wrong);
    CHECK(error_of(std::string("{\"a\":") + wrong + "}", {{"a", into(whole)}}) ==
          "'a' is not a whole number from 0 to 18446744073709551615");
  }
  for (const char* wrong : {"1e999", "-1e999", "\"1\"", "null", "[]", "{}", "NaN", "01", "1."}) {
    INFO(wrong);
    CHECK(error_of(std::string("{\"a\":") + wrong + "}", {{"a", into(number)}}) ==
          "'a' is not a number");
  }
  for (const char* wrong : {"1", "true", "null", "[\"\"]", "{}"}) {
    CHECK(error_of(std::string("{\"a\":") + wrong + "}", {{"a", into(text)}}) ==
          "'a' is not a string");
  }
  for (const char* wrong : {"[]", "1", "\"{}\"", "null"})
    CHECK(error_of(wrong) == "expected a JSON object");
  const JsonField list{"a",
                       [](JsonValue value) { value.each_item([](JsonValue it) { it.number(); }); }};
  CHECK(error_of("{\"a\":{}}", {list}) == "'a' is not a list");
  CHECK(error_of("{\"a\":[1,\"2\"]}", {list}) == "an item of 'a' is not a number");
}

TEST_CASE("fields may come in any order, once each, and others are checked and skipped") {
  double a = 0, b = 0;
  CHECK(error_of(R"({"b":2,"x":[{"y":null}],"a":1})", {{"a", into(a)}, {"b", into(b)}}) == "");
  CHECK(a == 1);
  CHECK(b == 2);
  CHECK(error_of(R"({"b":2})", {{"a", into(a)}, {"b", into(b)}}) == "'a' is missing");
  CHECK(error_of(R"({"b":2})", {{"a", into(a), true}, {"b", into(b)}}) == "");
  CHECK(error_of(R"({"b":2,"b":3})", {{"b", into(b)}}) == "'b' is given twice");
  CHECK(error_of(R"({"\u0062":4})", {{"b", into(b)}}) == "");
  CHECK(b == 4);
}

TEST_CASE("what is no JSON is refused, also in what nobody asks for") {
  for (const std::string text : {"",
                                 " ",
                                 "{",
                                 "}",
                                 "{\"a\":1",
                                 "{\"a\":1}}",
                                 "{\"a\":1}{",
                                 "{\"a\":1} x",
                                 "{\"a\" 1}",
                                 "{\"a\":}",
                                 "{\"a\":1,}",
                                 "{,}",
                                 "{\"a\":[1,]}",
                                 "{\"a\":[}",
                                 "{\"a\":{]}",
                                 "{\"a\":[1}",
                                 "{\"a\":[1 2]}",
                                 "{a:1}",
                                 "{\"a\":tru}",
                                 "{\"a\":truex}",
                                 "{\"a\":nul}",
                                 "{\"a\":01}",
                                 "{\"a\":1.}",
                                 "{\"a\":.5}",
                                 "{\"a\":+1}",
                                 "{\"a\":-}",
                                 "{\"a\":1e}",
                                 "{\"a\":1e999}",
                                 "{\"a\":\"\\q\"}",
                                 "{\"a\":\"\\u12\"}",
                                 "{\"a\":\"\\ud800\"}",
                                 "{\"a\":\"\n\"}",
                                 "{\"a\":\"\xff\"}",
                                 "{\"\xc3\":1}",
                                 "{\"a\":\"",
                                 "{\"a\":'1'}",
                                 "nonsense"}) {
    INFO(text);
    CHECK(error_of(text).ends_with(text == "nonsense" ? "" : "not JSON"));
    CHECK(error_of(text) != "");
  }
}

TEST_CASE("what JSON is, another reader says too") {
  std::mt19937 random(1);
  constexpr std::string_view kOthers = "{}[],:\"\\0-.e tnu\x80";
  int good = 0, bad = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = "{\"a\":" + random_json(random, 4) + "}";
    for (auto damages = random() % 3; damages > 0; --damages) {
      text[random() % text.size()] = kOthers[random() % kOthers.size()];
    }
    const auto other = nlohmann::json::parse(text, nullptr, false);
    INFO(text);
    REQUIRE((error_of(text) == "") == other.is_object());
    ++(other.is_object() ? good : bad);
  }
  CHECK(good > 1000);
  CHECK(bad > 1000);
}

TEST_CASE("values that nest deeper than any that is written are refused, however deep") {
  const auto nested = [](std::size_t levels) {
    return "{\"a\":" + std::string(levels, '[') + std::string(levels, ']') + "}";
  };
  CHECK(error_of(nested(JsonValue::kDeepest)) == "");
  for (const std::size_t levels : {std::size_t{JsonValue::kDeepest} + 1, std::size_t{5'000'000}}) {
    CHECK(error_of(nested(levels)) == "values are nested deeper than 64 levels");
    std::string text;
    CHECK(error_of(nested(levels), {{"a", into(text)}}) == "'a' is not a string");
  }
}

}  // namespace lockstep::host
