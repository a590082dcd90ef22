// Leaves at entries whose type is not strict: what they read is converted, and so is what they
// write.
#include <catch2/catch.hpp>
#include <optional>

#include "leaves/plugin/contract/leaf_set.h"
#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

const lockstep_host& entry_host = host_table();

// One Lab leaf; its inouts are bound to entries 0 to 3: int, double, string, list.
struct LooseFixture {
  explicit LooseFixture(Typing typing = Typing::Declared) {
    lab = {};
    Diagnostics diagnostics;
    REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
    tree = lab_tree(*plugins.types().at(0), 1);
    for (Slot& slot : tree.slots) slot.typing = typing;
    blackboard.emplace(tree);
    set.emplace(tree, *blackboard, time, 7, LeafLog());
  }
  const lockstep_caller* leaf() const { return lab.leaves.at(0); }
  Entry& entry(std::size_t index) { return blackboard->entries.at(index); }

  PluginSet plugins;
  Tree tree;
  std::optional<Blackboard> blackboard;
  LeafTime time{std::chrono::milliseconds(0), std::chrono::milliseconds(10)};
  std::optional<LeafSet> set;
};

std::optional<std::int64_t> read_int(const LooseFixture& fixture) {
  std::int64_t value = 0;
  if (!entry_host.get_int(fixture.leaf(), kCount, &value)) return std::nullopt;
  return value;
}

std::optional<double> read_double(const LooseFixture& fixture) {
  double value = 0;
  if (!entry_host.get_double(fixture.leaf(), kSpeed, &value)) return std::nullopt;
  return value;
}

std::optional<std::string> read_string(const LooseFixture& fixture) {
  const char* text = nullptr;
  std::size_t length = 0;
  if (!entry_host.get_string(fixture.leaf(), kText, &text, &length)) return std::nullopt;
  return std::string(text, length);
}

}  // namespace

TEST_CASE("a leaf reads what an entry of another type has, converted") {
  LooseFixture fixture;
  for (std::size_t i = 0; i < 4; ++i) {  // a start value counts as a write
    CHECK(fixture.entry(i).writes() == (fixture.entry(i).has_value() ? 1 : 0));
  }
  fixture.entry(0).assign(std::string("12abc"));
  CHECK(read_int(fixture) == 12);
  fixture.entry(0).assign(3.0);
  CHECK(read_int(fixture) == 3);
  fixture.entry(0).assign(3.5);
  CHECK_FALSE(read_int(fixture));
  fixture.entry(0).assign(true);
  CHECK(read_int(fixture) == 1);
  fixture.entry(1).assign(std::string("2.5"));
  CHECK(read_double(fixture) == 2.5);
  fixture.entry(1).assign(std::int64_t{2});
  CHECK(read_double(fixture) == 2.0);
  fixture.entry(2).assign(1.5);
  CHECK(read_string(fixture) == "1.500000");
  fixture.entry(2).assign(std::int64_t{5});
  CHECK(read_string(fixture) == "5");
  fixture.entry(2).assign(std::vector<double>{1});
  CHECK_FALSE(read_string(fixture));

  fixture.entry(3).assign(std::string("1;2.5"));
  const double* list = nullptr;
  std::size_t count = 0;
  REQUIRE(entry_host.get_double_list(fixture.leaf(), kList, &list, &count));
  CHECK(std::vector(list, list + count) == std::vector{1.0, 2.5});

  fixture.entry(1).assign(2.5);
  std::int64_t whole = 77;
  CHECK_FALSE(entry_host.get_int(fixture.leaf(), kSpeed, &whole));  // another type than the port's
  unset_entry(fixture.entry(0));
  CHECK_FALSE(read_int(fixture));
  CHECK(fixture.entry(0).writes() == 0);
}

TEST_CASE("the error of a leaf that reads what is not of its type says what the entry has") {
  LooseFixture fixture;
  fixture.entry(0).assign(std::string("many"));
  CHECK_FALSE(read_int(fixture));
  entry_host.set_empty_port(fixture.leaf(), kCount);
  const std::string entry = fixture.tree.slots[0].name;
  CHECK(std::string(fixture.set->slots()[0].error) ==
        "port 'count' has no value: the entry '{" + entry +
            "}' has 'many', which is not a whole number");
}

TEST_CASE("the host completes no text of a leaf") {
  LooseFixture fixture;
  unset_entry(fixture.entry(0));
  entry_host.set_error(fixture.leaf(), "port 'count' has no value");
  CHECK(std::string(fixture.set->slots()[0].error) == "port 'count' has no value");
}

TEST_CASE("a leaf writes entries as their type says, and gives them one") {
  LooseFixture fixture;
  fixture.entry(0).type = ValueType::Double;
  CHECK(entry_host.set_int(fixture.leaf(), kCount, 3));
  CHECK(fixture.entry(0).value() == Value(3.0));
  CHECK(read_int(fixture) == 3);
  fixture.entry(2).type = ValueType::Int;
  CHECK(entry_host.set_string(fixture.leaf(), kText, "12", 2));
  CHECK(fixture.entry(2).value() == Value(std::int64_t{12}));
  CHECK_FALSE(entry_host.set_string(fixture.leaf(), kText, "a", 1));
  CHECK(fixture.entry(2).value() == Value(std::int64_t{12}));
  CHECK(fixture.entry(2).writes() == 2);  // with the start value

  LooseFixture open(Typing::Any);
  CHECK(entry_host.set_int(open.leaf(), kCount, 3));
  CHECK(open.entry(0).typing == Typing::Declared);
  CHECK(open.entry(0).type == ValueType::Int);
  const double list[] = {1, 2};
  unset_entry(open.entry(3));
  CHECK(entry_host.set_double_list(open.leaf(), kList, list, 2));
  CHECK(open.entry(3).type == ValueType::DoubleList);
  CHECK(open.entry(3).is_present);
  CHECK(open.entry(3).value() == Value(std::vector<double>{1, 2}));
  CHECK(open.entry(3).writes() == 1);
}

}  // namespace lockstep::host::test
