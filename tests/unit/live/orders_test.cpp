// What may be ordered of a run: which values an entry takes, and why it takes no other.
#include "record/live/orders.h"
#include "run/shape_of.h"

#include <catch2/catch.hpp>
#include <string>

#include "dialect/btcpp/rules.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

struct Row {
  std::string_view entry, value;  // as JSON
  std::string_view taken;         // as the entry has it; "": it is refused
  std::string_view why = "";
};

void check(const Tree& tree, const Row& row) {
  const auto order = read_order(shape_of(tree), false,
                                R"({"do":"set","entry":")" + std::string(row.entry) +
                                    R"(","value":)" + std::string(row.value) + "}");
  INFO(row.entry << " = " << row.value << (order ? "" : ": " + order.error().message));
  CHECK(order.has_value() == row.why.empty());
  if (order && row.why.empty()) CHECK(to_text(order->value) == row.taken);
  if (order || row.why.empty()) return;
  CHECK(order.error().message.find(row.why) != std::string::npos);
}

}  // namespace

TEST_CASE("orders: an entry with a type takes its values, and refuses others with a reason") {
  const Tree tree = tree_from_text(
      "Sequence(Script[code=f:=true] Script[code=n:=1] Script[code=x:=0.5] Script[code=s:='a'])");
  constexpr Row kRows[] = {
      {"f", R"("false")", "false"},
      {"f", R"("true")", "true"},
      {"f", R"("False")", "false"},
      {"f", R"("TRUE")", "true"},
      {"f", R"("0")", "false"},
      {"f", R"("1")", "true"},
      {"f", "false", "false"},
      {"f", "true", "true"},
      {"f", "0", "false"},
      {"f", "1", "true"},
      {"f", R"("2")", "", "'2' is not true or false, which 'f' holds"},
      {"f", R"("no")", "", "'no' is not true or false"},
      {"f", R"("")", "", "'' is not true or false"},
      {"f", "2", "", "'2' is not true or false"},
      {"f", "0.5", "", "'0.5' is not true or false"},
      {"f", "null", "", "'value'"},
      {"f", "[true]", "", "'value'"},
      {"f", R"({"x":1})", "", "'value'"},
      {"n", R"("7")", "7"},
      {"n", "7", "7"},
      {"n", "-7", "-7"},
      {"n", R"("true")", "", "'true' is not a whole number, which 'n' holds"},
      {"n", "true", "", "'true' is not a whole number"},
      {"n", "7.5", "", "is not a whole number"},
      {"n", R"("9223372036854775808")", "", "is not a whole number"},
      {"x", R"("1e-3")", "0.001"},
      {"x", "0.25", "0.25"},
      {"x", R"("nan")", "", "'nan' is not"},
      {"x", R"("false")", "", "'false' is not"},
      {"s", R"("false")", "false"},
      {"s", R"("")", ""},
      {"s", "false", "false"},
      {"t", R"("1")", "", "the tree has no entry 't'"},
  };
  for (const Row& row : kRows) check(tree, row);
}

TEST_CASE("orders: an entry of any type takes a number or a truth value where the text is one") {
  const Tree tree = tree_from_text("Sequence(Script[code=a:=1] Script[code=b:=a])", btcpp::kRules);
  const auto value_of = [&](const std::string& json) {
    const auto order =
        read_order(shape_of(tree), false, R"({"do":"set","entry":"a","value":)" + json + "}");
    REQUIRE(order);
    return order->value;
  };
  CHECK(value_of(R"("false")") == Value(false));
  CHECK(value_of(R"("true")") == Value(true));
  CHECK(value_of("false") == Value(false));
  CHECK(value_of(R"("0")") == Value(std::int64_t{0}));
  CHECK(value_of("1") == Value(std::int64_t{1}));
  CHECK(value_of(R"("0.5")") == Value(0.5));
  CHECK(value_of(R"("no")") == Value(std::string("no")));
}

TEST_CASE("orders: what an order cannot do without is named where it is missing") {
  const Tree tree =
      tree_from_text("Sequence(Script[code=s:='a'] Ask[text=One?] Ask[text=Two?;name=two])");
  for (const auto& [order, key] : {std::pair<std::string, std::string>{"speed", "factor"},
                                   {R"(set","value":"b)", "entry"},
                                   {R"(set","entry":"s)", "value"},
                                   {R"(break","when":"begins)", "node"},
                                   {R"(break","node":0,"by":")", "when"},
                                   {R"(answer","node":2,"by":")", "answer"},
                                   {R"(answer","answer":"yes)", "node"}}) {
    INFO(order);
    const auto read = read_order(shape_of(tree), false, R"({"do":")" + order + R"("})");
    REQUIRE_FALSE(read);
    CHECK(read.error().message == "'" + key + "' is missing");
  }
}

}  // namespace lockstep::host::test
