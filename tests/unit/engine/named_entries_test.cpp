// Names that are known only while a tree runs: whose board they are on, and which entry they mean.
#include "engine/named_entries.h"

#include <catch2/catch.hpp>

using namespace lockstep::host;

namespace {

// main (a = entry 0, b = 1) > pick (target -> a, speed = its own, 2) > place (autoremap, object ->
// @b, and item -> target)
std::vector<Board> boards() {
  return {{.entries = {{"a", 0}, {"b", 1}}},
          {.parent = 0,
           .node = 3,
           .remapped = {{"target", "a"}},
           .own = {"speed"},
           .entries = {{"speed", 2}}},
          {.parent = 1,
           .node = 7,
           .autoremap = true,
           .remapped = {{"object", "@b"}, {"item", "target"}},
           .own = {"local"},
           .entries = {{"local", 3}}}};
}

}  // namespace

TEST_CASE("a key is at home on the board where remappings end") {
  const auto all = boards();
  struct Row {
    std::uint32_t board;
    std::string_view key;
    std::uint32_t home;
    std::string_view there;
  };
  const Row rows[] = {{0, "a", 0, "a"},         {0, "new", 0, "new"},
                      {0, "@a", 0, "a"},        {0, "@", 0, "@"},
                      {1, "target", 0, "a"},    {1, "speed", 1, "speed"},
                      {1, "a", 1, "a"},         {1, "@a", 0, "a"},
                      {2, "object", 0, "b"},    {2, "item", 0, "a"},
                      {2, "target", 0, "a"},    {2, "speed", 1, "speed"},
                      {2, "local", 2, "local"}, {2, "_hidden", 2, "_hidden"},
                      {2, "fresh", 1, "fresh"}, {2, "@fresh", 0, "fresh"}};
  for (const Row& row : rows) {
    INFO(row.key << " on board " << row.board);
    const Home home = home_of(all, row.board, row.key);
    CHECK(home.board == row.home);
    CHECK(home.key == row.there);
  }
}

TEST_CASE("a name means an entry of the tree, or one that is made for it and does not move") {
  const auto all = boards();
  std::vector<Entry> slots(4);
  NamedEntries named(all, slots);
  CHECK(&named.at(0, "a") == &slots[0]);
  CHECK(&named.at(2, "item") == &slots[0]);
  CHECK(&named.at(2, "speed") == &slots[2]);
  Entry& fresh = named.at(2, "fresh");
  CHECK_FALSE(fresh.is_present);
  CHECK(write_entry(fresh, ValueType::Int, nullptr, std::int64_t{5}));
  for (int i = 0; i < 1000; ++i) named.at(1, "k" + std::to_string(i));
  CHECK(&named.at(2, "fresh") == &fresh);
  CHECK(&named.at(1, "fresh") == &fresh);
  CHECK(&named.at(0, "fresh") != &fresh);
  CHECK(fresh.value() == Value(std::int64_t{5}));
  CHECK(named.own(1, "speed") == &slots[2]);
  CHECK(named.own(0, "b") == &slots[1]);
  CHECK(named.own(0, "@b") == nullptr);
  CHECK(named.own(1, "target") == nullptr);
  CHECK(named.own(2, "fresh") == nullptr);
  named.reset();
  CHECK_FALSE(fresh.is_present);
  CHECK(&named.at(1, "fresh") == &fresh);
}
