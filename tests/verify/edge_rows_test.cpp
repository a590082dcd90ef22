// Packed edges are the edges that were packed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "verify/edge_rows.h"

namespace lockstep::host::test {
namespace {

std::vector<Edge> all_of(EdgeRow row) {
  std::vector<Edge> edges;
  for (const Edge& edge : row) edges.push_back(edge);
  return edges;
}

// Edges of a state, some to states that are beside each other.
std::vector<Edge> random_edges(std::mt19937& random, std::size_t most) {
  std::set<Edge> edges;
  const std::size_t count = random() % (most + 1);
  while (edges.size() < count) {
    const StateId to = random() % 4 == 0 ? static_cast<StateId>(random()) & 0x7fffffff
                                         : static_cast<StateId>(random() % 200);
    const std::uint32_t label = random() % 3 == 0 ? static_cast<std::uint32_t>(random()) : 1;
    for (StateId i = 0, row = static_cast<StateId>(random() % 5); i <= row; ++i)
      edges.insert({to + i, label});
  }
  return {edges.begin(), edges.end()};
}

}  // namespace

TEST_CASE("packed edges: a table of rows") {
  const std::vector<std::vector<Edge>> rows{
      {},
      {{0, 0}},
      {{0, 7}, {0, 8}, {0, 9}},
      {{1, 0}, {2, 0}, {3, 0}, {4, 1}, {5, 1}, {7, 1}},
      {{0x7fffffff, 0xffffffff}},
      {{0, 0xffffffff}, {0x7ffffffe, 0}, {0x7fffffff, 0}},
  };
  EdgeRows packed;
  for (const auto& row : rows) packed.add(row);
  REQUIRE(packed.states() == rows.size());
  CHECK(packed.size() == 14);
  for (StateId state = 0; state < rows.size(); ++state) {
    INFO(state);
    CHECK(all_of(packed[state]) == rows[state]);
  }
}

TEST_CASE("packed edges: a row may have a label of the end") {
  EdgeRows packed;
  const std::vector<Edge> edges{{0, 7}, {1, 7}, {2, 0}};
  packed.add(edges, 300);
  packed.add({}, 0);
  packed.add(edges);
  packed.add({});
  CHECK(packed[0].label_of_end() == 300u);
  CHECK(all_of(packed[0]) == edges);
  CHECK(packed[1].label_of_end() == 0u);
  CHECK(all_of(packed[1]).empty());
  CHECK_FALSE(packed[2].label_of_end());
  CHECK(all_of(packed[2]) == edges);
  CHECK_FALSE(packed[3].label_of_end());
  CHECK(packed.size() == 6);
}

TEST_CASE("packed edges: random rows come back, and take less room than they did") {
  std::mt19937 random(7);
  std::vector<std::vector<Edge>> rows;
  EdgeRows packed;
  for (int i = 0; i < 1000; ++i) packed.add(rows.emplace_back(random_edges(random, 100)));
  for (StateId state = 0; state < rows.size(); ++state) {
    INFO(state);
    CHECK(all_of(packed[state]) == rows[state]);
  }
  CHECK(packed.memory() < packed.size() * sizeof(Edge));
}

TEST_CASE("rows of bytes come back, also after a clear") {
  std::mt19937 random(8);
  ByteRows bytes;
  for (int round = 0; round < 3; ++round) {
    std::vector<std::vector<std::byte>> rows(300);
    for (auto& row : rows) {
      row.resize(random() % 50);
      for (std::byte& it : row) it = static_cast<std::byte>(random());
      bytes.add(row);
    }
    REQUIRE(bytes.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      CHECK(std::ranges::equal(bytes[i], rows[i]));
    }
    bytes.clear();
    CHECK(bytes.size() == 0);
  }
}

}  // namespace lockstep::host::test
