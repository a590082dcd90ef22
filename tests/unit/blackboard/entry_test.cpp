// What ports write into entries of their type, of another, and of none.
#include "base/blackboard/entry.h"

#include <catch2/catch.hpp>
#include <type_traits>

using namespace lockstep::host;

namespace {

using Whole = std::int64_t;

Entry entry_of(Typing typing, ValueType type, Value value = {}) {
  Entry entry;
  make_entry(entry, typing, type);
  entry.assign(std::move(value));
  entry.count_from(0);
  return entry;
}

Entry no_entry() {
  Entry entry;
  unset_entry(entry);
  return entry;
}

}  // namespace

TEST_CASE("a port writes an entry, which gets its type or converts the value") {
  struct Row {
    const char* what;
    Entry before;
    ValueType type;
    Value value;
    std::optional<Value> after;  // nothing: it is refused
    Typing typing;
    ValueType type_after;
  };
  const Value text = std::string("7x");
  const Row rows[] = {
      {"missing", no_entry(), ValueType::Int, Whole{3}, Whole{3}, Typing::Declared, ValueType::Int},
      {"missing, text", no_entry(), ValueType::String, text, text, Typing::Any, ValueType::String},
      {"any", entry_of(Typing::Any, ValueType::String, 2.5), ValueType::Int, Whole{3}, Whole{3},
       Typing::Declared, ValueType::Int},
      {"any, text", entry_of(Typing::Any, ValueType::String), ValueType::String, text, text,
       Typing::Declared, ValueType::String},
      {"its type", entry_of(Typing::Declared, ValueType::Int, Whole{1}), ValueType::Int, Whole{3},
       Whole{3}, Typing::Declared, ValueType::Int},
      {"its type, and a number that a script has made real",
       entry_of(Typing::Declared, ValueType::Int, 1.5), ValueType::Int, Whole{3}, 3.0,
       Typing::Declared, ValueType::Int},
      {"a text for a number", entry_of(Typing::Declared, ValueType::Int), ValueType::String, text,
       Whole{7}, Typing::Declared, ValueType::Int},
      {"a number that fits", entry_of(Typing::Declared, ValueType::Int), ValueType::Double, 2.0,
       Whole{2}, Typing::Declared, ValueType::Int},
      {"a number that does not fit", entry_of(Typing::Declared, ValueType::Int), ValueType::Double,
       2.5, std::nullopt, Typing::Declared, ValueType::Int},
      {"a number for a text", entry_of(Typing::Declared, ValueType::String), ValueType::Int,
       Whole{3}, std::nullopt, Typing::Declared, ValueType::String},
      {"a text that is no number", entry_of(Typing::Declared, ValueType::Double), ValueType::String,
       std::string("x"), std::nullopt, Typing::Declared, ValueType::Double},
      {"a list for a number", entry_of(Typing::Declared, ValueType::Double), ValueType::DoubleList,
       std::vector<double>{1}, std::nullopt, Typing::Declared, ValueType::Double},
  };
  for (const Row& row : rows) {
    INFO(row.what);
    Entry entry = row.before;
    CHECK(write_entry(entry, row.type, nullptr, row.value) == row.after.has_value());
    CHECK(entry.value() == row.after.value_or(row.before.value()));
    CHECK(entry.writes() == (row.after ? 1 : 0));
    CHECK(entry.is_present);
    CHECK(entry.typing == row.typing);
    CHECK(entry.type == row.type_after);
  }
}

TEST_CASE("an entry that was removed begins again") {
  Entry entry = entry_of(Typing::Declared, ValueType::Int, Whole{3});
  entry.count_from(5);
  unset_entry(entry);
  CHECK_FALSE(entry.is_present);
  CHECK_FALSE(entry.has_value());
  CHECK(write_entry(entry, ValueType::Double, nullptr, 2.5));
  CHECK(entry.writes() == 1);
  CHECK(entry.type == ValueType::Double);
}

TEST_CASE("each change of a value is counted") {
  Entry entry = entry_of(Typing::Any, ValueType::String, 1.5);
  entry.assign(Value(2.5));
  CHECK(entry.writes() == 1);
  const Value text = std::string("a text");
  entry.assign(text);
  CHECK(entry.value() == text);
  entry.assign(Value(Whole{1}));
  entry.assign_same(Whole{2});
  CHECK(entry.value() == Value(Whole{2}));
  entry.to_write() = NoValue();
  CHECK(entry.writes() == 5);
  CHECK_FALSE(entry.has_value());
  static_assert(std::is_const_v<std::remove_reference_t<decltype(entry.value())>>);
}
