// Values as values of another type: texts that are read, numbers that are cast.
#include "base/blackboard/conversion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace lockstep::host;

namespace {

using Whole = std::int64_t;
using Doubles = std::vector<double>;
using Wholes = std::vector<std::int64_t>;
using Flags = std::vector<Flag>;
using Texts = std::vector<std::string>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a text is read as a value of a type, and its rest is ignored") {
  struct Row {
    ValueType type;
    std::string text;
    std::optional<Value> value;
    bool has_rest = false;
  };
  const Row rows[] = {
      {ValueType::Int, "12", Whole{12}},
      {ValueType::Int, "-12", Whole{-12}},
      {ValueType::Int, "12abc", Whole{12}, true},
      {ValueType::Int, "3.7", Whole{3}, true},
      {ValueType::Int, "0x10", Whole{0}, true},
      {ValueType::Int, "5 ", Whole{5}, true},
      {ValueType::Int, "+5", std::nullopt},
      {ValueType::Int, " 5", std::nullopt},
      {ValueType::Int, "", std::nullopt},
      {ValueType::Int, "-", std::nullopt},
      {ValueType::Int, "five", std::nullopt},
      {ValueType::Int, "9223372036854775807", std::numeric_limits<Whole>::max()},
      {ValueType::Int, "9223372036854775808", std::nullopt},
      {ValueType::Double, "2.5", 2.5},
      {ValueType::Double, "-1e-3", -1e-3},
      {ValueType::Double, ".5", 0.5},
      {ValueType::Double, "5.", 5.0},
      {ValueType::Double, "0,5", 0.0, true},
      {ValueType::Double, "2.5xyz", 2.5, true},
      {ValueType::Double, "1e", 1.0, true},
      {ValueType::Double, "inf", kInfinity},
      {ValueType::Double, "-inf", -kInfinity},
      {ValueType::Double, "+1", std::nullopt},
      {ValueType::Double, " 1", std::nullopt},
      {ValueType::Double, "", std::nullopt},
      {ValueType::Double, "1e999", std::nullopt},
      {ValueType::Number, "3", Whole{3}},
      {ValueType::Number, "3.5", 3.5},
      {ValueType::Number, "3x", 3.0, true},
      {ValueType::Bool, "1", true},
      {ValueType::Bool, "0", false},
      {ValueType::Bool, "true", true},
      {ValueType::Bool, "false", false},
      {ValueType::Bool, "TRUE", true},
      {ValueType::Bool, "FALSE", false},
      {ValueType::Bool, "True", true},
      {ValueType::Bool, "False", false},
      {ValueType::Bool, "tRUE", std::nullopt},
      {ValueType::Bool, "2", std::nullopt},
      {ValueType::Bool, "true ", std::nullopt},
      {ValueType::String, " a ", std::string(" a ")},
      {ValueType::String, "", std::string()},
      {ValueType::DoubleList, "", Doubles{}},
      {ValueType::DoubleList, "1;2.5", Doubles{1, 2.5}},
      {ValueType::DoubleList, "1;2;", Doubles{1, 2}},
      {ValueType::DoubleList, "1; 2", std::nullopt},
      {ValueType::DoubleList, "1;;2", std::nullopt},
      {ValueType::DoubleList, ";", std::nullopt},
      {ValueType::DoubleList, "1x;2", Doubles{1, 2}, true},
      {ValueType::IntList, "1;-2", Wholes{1, -2}},
      {ValueType::IntList, "1;a", std::nullopt},
      {ValueType::BoolList, "true;0;True", Flags{{true}, {false}, {true}}},
      {ValueType::BoolList, "yes", std::nullopt},
      {ValueType::StringList, "a; b;", Texts{"a", " b"}},
      {ValueType::StringList, "a;;b", Texts{"a", "", "b"}},
      {ValueType::DoubleList, "json:[1, 2.5]", Doubles{1, 2.5}},
      {ValueType::DoubleList, "json:[]", Doubles{}},
      {ValueType::IntList, "json:[1,-2]", Wholes{1, -2}},
      {ValueType::IntList, "json:[1.5]", std::nullopt},
      {ValueType::BoolList, "json:[true,false]", Flags{{true}, {false}}},
      {ValueType::BoolList, "json:[1]", std::nullopt},
      {ValueType::StringList, R"(json:["a;b", "\u00e4"])", Texts{"a;b", "ä"}},
      {ValueType::StringList, "json:[1]", std::nullopt},
      {ValueType::DoubleList, "json:[1", std::nullopt},
      {ValueType::DoubleList, "json:{}", std::nullopt},
      {ValueType::DoubleList, R"(json:[1],"list":[2])", std::nullopt},
      {ValueType::DoubleList, "json:", std::nullopt},
  };
  for (const Row& row : rows) {
    INFO(to_string(row.type) << " '" << row.text << "'");
    const auto read = value_from_text(row.type, nullptr, row.text);
    REQUIRE(read.has_value() == row.value.has_value());
    if (!read) continue;
    CHECK(read->value == *row.value);
    CHECK(read->has_rest == row.has_rest);
  }
  const auto nan = value_from_text(ValueType::Double, nullptr, "nan");
  REQUIRE(nan.has_value());
  CHECK(std::isnan(std::get<double>(nan->value)));
}

TEST_CASE("a value is cast to another type when it has the same value there") {
  struct Row {
    Value from;
    ValueType type;
    std::optional<Value> to;
  };
  const Row rows[] = {
      {Whole{1}, ValueType::Bool, true},
      {Whole{0}, ValueType::Bool, false},
      {Whole{2}, ValueType::Bool, std::nullopt},
      {Whole{3}, ValueType::Double, 3.0},
      {Whole{kLargestExact}, ValueType::Double, 9007199254740991.0},
      {Whole{kLargestExact + 1}, ValueType::Double, std::nullopt},
      {Whole{-kLargestExact - 1}, ValueType::Double, std::nullopt},
      {Whole{3}, ValueType::Number, Whole{3}},
      {Whole{-7}, ValueType::String, std::string("-7")},
      {3.0, ValueType::Int, Whole{3}},
      {3.5, ValueType::Int, std::nullopt},
      {9.3e18, ValueType::Int, std::nullopt},
      {-9223372036854775808.0, ValueType::Int, std::numeric_limits<Whole>::min()},
      {kInfinity, ValueType::Int, std::nullopt},
      {0.0, ValueType::Bool, false},
      {0.5, ValueType::Bool, true},
      {-0.5, ValueType::Bool, std::nullopt},
      {std::nan(""), ValueType::Bool, true},
      {1.5, ValueType::String, std::string("1.500000")},
      {kInfinity, ValueType::String, std::string("inf")},
      {1.5, ValueType::Number, 1.5},
      {true, ValueType::Int, Whole{1}},
      {true, ValueType::Double, 1.0},
      {true, ValueType::String, std::string("1")},
      {true, ValueType::Bool, true},
      {3.0, ValueType::DoubleList, std::nullopt},
      {Doubles{1}, ValueType::DoubleList, Doubles{1}},
      {Doubles{1}, ValueType::IntList, std::nullopt},
      {Doubles{1}, ValueType::Double, std::nullopt},
      {Doubles{1}, ValueType::String, std::nullopt},
      {Value(), ValueType::Int, std::nullopt},
      {Value(), ValueType::String, std::nullopt},
      {std::string("12"), ValueType::Int, std::nullopt},  // a text is read, not cast
  };
  for (const Row& row : rows) {
    INFO(to_text(row.from) << " as " << to_string(row.type));
    CHECK(cast_value(row.from, row.type, nullptr) == row.to);
  }
  CHECK(convert_value(std::string("12"), ValueType::Int, nullptr) == Value(Whole{12}));
  CHECK(convert_value(std::string("12"), ValueType::String, nullptr) == Value(std::string("12")));
  CHECK(convert_value(1.0, ValueType::Int, nullptr) == Value(Whole{1}));
}
