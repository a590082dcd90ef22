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
  for (std::uint32_t i = 0; i < leaves; ++i) {
    shape.moving_leaves.push_back(i);
    shape.held_of_leaf.push_back(i < leaves / 2 ? static_cast<MovingPlace>(i)
                                                : LabelShape::kNowhere);
    if (i < leaves / 2) shape.moving_held.push_back(i);
  }
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

TEST_CASE("packed labels: leaves that change places twice are where they were") {
  std::mt19937 random(8);
  const LabelShape shape = shape_of(40);
  for (int i = 0; i < 100; ++i) {
    const Label label = random_label(shape, random);
    // Both are held, or both are not.
    const std::size_t first = random() % 20, second = random() % 20, half = random() % 2 * 20;
    Label changed = label;
    shape.exchange_before(changed, half + first, half + second);
    shape.exchange_after(changed, half + first, half + second);
    shape.exchange_after(changed, half + first, half + second);
    shape.exchange_before(changed, half + second, half + first);
    CHECK(changed == label);
  }
}

}  // namespace lockstep::host::test
