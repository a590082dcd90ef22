#include "base/core/value.h"

#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace lockstep::host;

namespace {

const std::string kManyZeros(400, '0');

struct Row {
  ValueType type;
  std::string text;
  std::optional<Value> value;
};

std::vector<double> list(std::initializer_list<double> numbers) {
  return numbers;
}

using Ints = std::vector<std::int64_t>;
using Flags = std::vector<Flag>;
using Strings = std::vector<std::string>;

}  // namespace

TEST_CASE("a text is a value of its type or nothing") {
  const Row rows[] = {
      {ValueType::Bool, "true", true},
      {ValueType::Bool, " false\n", false},
      {ValueType::Bool, "1", true},
      {ValueType::Bool, "0", false},
      {ValueType::Bool, "True", true},
      {ValueType::Bool, "FALSE", false},
      {ValueType::Bool, "tRUE", std::nullopt},
      {ValueType::Bool, "", std::nullopt},
      {ValueType::Int, "-12", std::int64_t{-12}},
      {ValueType::Int, " +12 ", std::int64_t{12}},
      {ValueType::Int, "9223372036854775807", std::numeric_limits<std::int64_t>::max()},
      {ValueType::Int, "9223372036854775808", std::nullopt},
      {ValueType::Int, "1.0", std::nullopt},
      {ValueType::Int, "+-1", std::nullopt},
      {ValueType::Int, "1 2", std::nullopt},
      {ValueType::Double, "0.25", 0.25},
      {ValueType::Double, "-1e-3", -1e-3},
      {ValueType::Double, ".5", 0.5},
      {ValueType::Double, "+", std::nullopt},
      {ValueType::Double, "inf", std::nullopt},
      {ValueType::Double, "nan", std::nullopt},
      {ValueType::Double, "1" + kManyZeros, std::nullopt},
      {ValueType::Double, "0x10", std::nullopt},
      {ValueType::Double, "0,5", std::nullopt},
      {ValueType::String, " as it is ", std::string(" as it is ")},
      {ValueType::DoubleList, "0.25;0.5;0.75", list({0.25, 0.5, 0.75})},
      {ValueType::DoubleList, " 1, 2\t3 ;4\n", list({1, 2, 3, 4})},
      {ValueType::DoubleList, "", list({})},
      {ValueType::DoubleList, "1;x", std::nullopt},
      {ValueType::IntList, "1;-2, +3\n4;", Ints{1, -2, 3, 4}},
      {ValueType::IntList, "", Ints{}},
      {ValueType::IntList, "1;0.5", std::nullopt},
      {ValueType::BoolList, "true;0, 1 false", Flags{{true}, {false}, {true}, {false}}},
      {ValueType::BoolList, "true;2", std::nullopt},
      {ValueType::StringList, "front door ; back, door;", Strings{"front door", "back, door"}},
      {ValueType::StringList, " \n", Strings{}},
      {ValueType::StringList, ";a", Strings{"", "a"}},
      {ValueType::StringList, R"(a\;b;\ c\ \\;\)", Strings{"a;b", R"( c \)", R"(\)"}},
      {ValueType::Number, " 3", std::int64_t{3}},
      {ValueType::Number, "3.0", 3.0},
      {ValueType::Number, "9223372036854775808", 9223372036854775808.0},
      {ValueType::Number, "three", std::nullopt},
  };
  for (const auto& row : rows) {
    INFO(to_string(row.type) << " '" << row.text << "'");
    CHECK(parse_value(row.type, row.text) == row.value);
  }
}

TEST_CASE("a value written as text reads back to the same value") {
  const std::pair<ValueType, Value> rows[] = {
      {ValueType::Bool, true},
      {ValueType::Bool, false},
      {ValueType::Int, std::numeric_limits<std::int64_t>::min()},
      {ValueType::Double, 0.1},
      {ValueType::Double, 1.0},
      {ValueType::Double, std::nextafter(1.0, 2.0)},
      {ValueType::Double, 1e300},
      {ValueType::String, std::string("a;b")},
      {ValueType::DoubleList, list({0.1, 1.0 / 3, 1})},
      {ValueType::DoubleList, list({})},
      {ValueType::IntList, Ints{1, -2}},
      {ValueType::BoolList, Flags{{true}, {false}}},
      {ValueType::StringList, Strings{}},
      {ValueType::StringList, Strings{""}},
      {ValueType::StringList, Strings{"a", ""}},
      {ValueType::StringList, Strings{"", "a;b", R"(c\)", " ", " \t d ", "e, f"}},
  };
  for (const auto& [type, value] : rows) {
    INFO(to_text(value));
    CHECK(parse_value(type, to_text(value)) == value);
  }
  CHECK(to_text(Value()).empty());
}

TEST_CASE("the text of a number is the shortest that is that number, as fmt writes it") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponents(-7, 19);
  std::vector<double> numbers{0, -0.0, 1, 0.1, 1e-4, 1e-5, 1e15, 1e16, 123456789012345680, -2.5e-7};
  for (const double edge : {1e-4, 1e16}) {
    numbers.push_back(std::nextafter(edge, 0));
    numbers.push_back(std::nextafter(edge, 1e300));
  }
  for (int i = 0; i < 20'000; ++i) {
    numbers.push_back(std::bit_cast<double>(random()));
    numbers.push_back(std::pow(10, exponents(random)));
    numbers.push_back(std::round(std::pow(10, exponents(random))));
  }
  for (const double number : numbers) {
    if (to_text(Value(number)) != fmt::format("{}", number)) {
      CHECK(to_text(Value(number)) == fmt::format("{}", number));
    }
  }
  for (const auto number : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                            std::int64_t{0}, std::numeric_limits<std::int64_t>::max()}) {
    CHECK(to_text(Value(number)) == fmt::format("{}", number));
  }
}

TEST_CASE("a value holds its type, and a number is an int or a double") {
  for (const ValueType type : all_value_types()) {
    INFO(to_string(type));
    if (type == ValueType::Object) continue;  // its text is a matter of its own type
    const auto value = parse_value(type, "1");
    REQUIRE(value);
    CHECK(holds(*value, type));
    CHECK(holds(*value, ValueType::Number) ==
          (type == ValueType::Number || type == ValueType::Int || type == ValueType::Double));
    CHECK_FALSE(holds(Value(), type));
  }
}
