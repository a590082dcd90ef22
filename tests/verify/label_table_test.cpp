// Packed labels are the labels that were packed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "verify/label_table.h"

namespace lockstep::host::test {
namespace {

// Some of its leaves may move, and half of those are held.
LabelShape shape_of(std::uint32_t leaves) {
  LabelShape shape{.leaves = leaves, .held = leaves / 2, .properties = 2};
  MovingChildren held{1, 1, {}}, others{1, 0, {}};
  for (std::uint32_t i = 0; i < leaves; ++i) {
    shape.moving_leaves.push_back(i);
    if (i < leaves / 2) shape.moving_held.push_back(i);
    (i < leaves / 2 ? held : others).places.push_back({i, i < leaves / 2 ? i : leaves / 2});
  }
  shape.moving_children = {held, others};
  return shape;
}

Label random_label(const LabelShape& shape, std::mt19937& random) {
  Label label;
  shape.clear(label);
  const std::size_t rows = random() % 4, bits = shape.begun_bit() + 1;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t begin = random() % bits, end = std::min(bits, begin + random() % 20);
    for (std::size_t bit = begin; bit < end; ++bit) label.set(bit);
  }
  const std::size_t moving = shape.moving_leaves.size();
  if (random() % 2 == 0) {
    const auto by = static_cast<std::ptrdiff_t>(random() % moving);
    const auto leaves = label.after.begin();
    std::rotate(leaves, leaves + by, leaves + static_cast<std::ptrdiff_t>(moving));
  }
  if (random() % 4 == 0) std::shuffle(label.after.begin(), label.after.end(), random);
  return label;
}

}  // namespace

TEST_CASE("packed labels: random labels come back, and each has one number") {
  std::mt19937 random(7);
  for (const std::uint32_t leaves : {1u, 7u, 40u, 300u}) {
    const LabelShape shape = shape_of(leaves);
    LabelTable table;
    for (int i = 0; i < 300; ++i) {
      INFO(leaves << ", label " << i);
      const Label label = random_label(shape, random);
      const std::uint32_t number = table.add(label);
      CHECK(table.add(label) == number);
      Label read;
      shape.clear(read);
      table.read(number, read);
      CHECK(read == label);
      bool are_same = true;
      for (std::size_t bit = 0; bit <= shape.begun_bit(); ++bit) {
        are_same = are_same && table.has(number, bit) == label.has(bit);
      }
      CHECK(are_same);
    }
  }
}

// Two children of two equal leaves each, all of which may be held.
LabelShape nested() {
  return {.leaves = 4,
          .held = 6,
          .properties = 0,
          .moving_leaves = {0, 1, 2, 3},
          .moving_held = {0, 2, 3, 1, 4, 5},  // each child, and the two in it
          .moving_children = {
              {2, 3, {{0, 0}, {2, 3}}}, {1, 1, {{0, 1}, {1, 2}}}, {1, 1, {{2, 4}, {3, 5}}}}};
}

TEST_CASE("equal children in equal children: each comes to the place of each other one") {
  const LabelShape shape = nested();
  for (std::size_t one = 0; one < 4; ++one) {
    for (std::size_t other = 0; other < 4; ++other) {
      INFO(one << " to " << other);
      const Swap swap{one, other};
      CHECK(shape.exchanged(swap, one) == other);
      std::vector<std::size_t> places;
      for (std::size_t i = 0; i < 10; ++i) places.push_back(shape.exchanged(swap, i));
      Label before, after;
      shape.clear(before);
      shape.clear(after);
      for (std::size_t i = 0; i < 4; ++i) {
        if (i == other) before.set(shape.worked_bit(shape.moving_leaves[i]));
      }
      shape.exchange_before(before, swap);
      shape.exchange_after(after, swap);
      for (std::size_t i = 0; i < 10; ++i) {
        CHECK(before.after[i] == places[i]);
        CHECK(after.after[i] == places[i]);
      }
      CHECK(before.has(shape.worked_bit(one)));
      // The child that may be held moves with the leaves in it.
      CHECK((places[4] == 4) == (one / 2 == other / 2));
      std::ranges::sort(places);
      CHECK(std::ranges::adjacent_find(places) == places.end());
    }
  }
}

TEST_CASE("equal children in equal children: who may change places with whom") {
  const LabelShape shape = nested();
  using Places = std::vector<MovingPlace>;
  Label label;
  shape.set_equals(std::vector<LabelShape::EqualChild>{{1, 1}}, label);
  CHECK(label.after == Places{0, 0, 2, 3, 4, 5, 5, 7, 8, 9});
  shape.set_equals(std::vector<LabelShape::EqualChild>{{0, 1}, {1, 1}, {2, 1}}, label);
  CHECK(label.after == Places{0, 0, 1, 2, 4, 5, 5, 4, 6, 8});
  // If the first leaf stays, its child does, and in the other child both may change places.
  CHECK(shape.equals_beside(label, 0).after == Places{0, 1, 2, 2, 4, 5, 6, 7, 8, 8});
  // If the first child stays, what is in it may change places.
  CHECK(shape.equals_beside(label, 4).after == Places{0, 0, 2, 2, 4, 5, 5, 7, 8, 8});
}

TEST_CASE("packed labels: leaves that change places twice are where they were") {
  std::mt19937 random(8);
  const LabelShape shape = shape_of(40);
  for (int i = 0; i < 100; ++i) {
    const Label label = random_label(shape, random);
    // Both are held, or both are not.
    const std::size_t first = random() % 20, second = random() % 20, half = random() % 2 * 20;
    Label changed = label;
    shape.exchange_before(changed, {half + first, half + second});
    shape.exchange_after(changed, {half + first, half + second});
    shape.exchange_after(changed, {half + first, half + second});
    shape.exchange_before(changed, {half + second, half + first});
    CHECK(changed == label);
  }
}

}  // namespace lockstep::host::test
