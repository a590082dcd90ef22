#include "verify/label_table.h"

#include <algorithm>
#include <numeric>

#include "verify/packed_numbers.h"
#include "verify/union_find.h"

namespace lockstep::host {
namespace {

// A number that is near 0, as one that is small.
std::uint64_t folded(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1u ^ static_cast<std::uint64_t>(number >> 63u);
}
std::int64_t unfolded(std::uint64_t number) {
  return static_cast<std::int64_t>(number >> 1u) ^ -static_cast<std::int64_t>(number & 1u);
}

void exchange_bits(Label& label, std::size_t one, std::size_t other) {
  if (label.has(one) == label.has(other)) return;
  label.bits[one / 8] ^= std::byte{1} << one % 8;
  label.bits[other / 8] ^= std::byte{1} << other % 8;
}

// Each row of bits that are set: its length, and how far it begins behind the one before it.
void pack_bits(const Label& label, std::vector<std::byte>& into) {
  const std::size_t size = label.bits.size() * 8;
  std::size_t end = 0;
  for (std::size_t bit = 0; bit < size;) {
    if (bit % 8 == 0 && label.bits[bit / 8] == std::byte{0}) {
      bit += 8;
      continue;
    }
    if (!label.has(bit)) {
      ++bit;
      continue;
    }
    const std::size_t begin = bit;
    while (bit < size && label.has(bit)) ++bit;
    put_number(into, bit - begin);
    put_number(into, begin - end);
    end = bit;
  }
}

// The same of what moves, and how far it does. Behind a 0, which is no length.
void pack_moves(const Label& label, std::vector<std::byte>& into) {
  const auto moves = [&](std::size_t i) {
    return static_cast<std::int64_t>(label.after[i]) - static_cast<std::int64_t>(i);
  };
  std::size_t end = 0;
  for (std::size_t i = 0; i < label.after.size();) {
    const std::int64_t far = moves(i);
    const std::size_t begin = i;
    while (i < label.after.size() && moves(i) == far) ++i;
    if (far == 0) continue;
    if (end == 0) put_number(into, 0);
    put_number(into, i - begin);
    put_number(into, begin - end);
    put_number(into, folded(far));
    end = i;
  }
}

}  // namespace

void LabelShape::clear(Label& label) const {
  label.bits.assign(begun_bit() / 8 + 1, std::byte{0});
  label.after.resize(moving_leaves.size() + moving_held.size());
  std::iota(label.after.begin(), label.after.end(), MovingPlace{0});
}

void LabelShape::clear_all_but_held(Label& label) const {
  const std::size_t first = held_bit(0), last = owed_bit(0);
  for (std::size_t byte = 0; byte < label.bits.size(); ++byte) {
    if (byte < first / 8 || byte > last / 8) label.bits[byte] = std::byte{0};
  }
  label.bits[last / 8] &= ~(~std::byte{0} << last % 8);
  label.bits[first / 8] &= ~std::byte{0} << first % 8;
  std::iota(label.after.begin(), label.after.end(), MovingPlace{0});
}

std::vector<LabelShape::Exchange> LabelShape::exchanges(const Swap& swap) const {
  std::vector<Exchange> found;
  std::size_t from = swap.one;
  for (std::size_t i = 0; i < moving_children.size() && from != swap.other; ++i) {
    const MovingChildren& all = moving_children[i];
    const Exchange it{i, child_with(all, from), child_with(all, swap.other)};
    if (it.one == kNoChild || it.other == kNoChild || it.one == it.other) continue;
    exchange(from, it);
    found.push_back(it);
  }
  return found;
}

std::size_t LabelShape::child_with(const MovingChildren& all, std::size_t place) const {
  const bool is_leaf = place < moving_leaves.size();
  const std::size_t number = is_leaf ? place : place - moving_leaves.size();
  const auto first = [&](const auto& it) { return is_leaf ? it.leaf : it.held; };
  const auto behind = std::ranges::upper_bound(all.places, number, {}, first);
  if (behind == all.places.begin()) return kNoChild;
  const auto child = std::prev(behind);
  if (number - first(*child) >= (is_leaf ? all.leaves : all.held)) return kNoChild;
  return static_cast<std::size_t>(child - all.places.begin());
}

void LabelShape::exchange(std::size_t& place, const Exchange& it) const {
  const MovingChildren& all = moving_children[it.children];
  const MovingChildren::Place &one = all.places[it.one], &other = all.places[it.other];
  const bool is_leaf = place < moving_leaves.size();
  const std::size_t before = is_leaf ? 0 : moving_leaves.size();
  const std::size_t size = is_leaf ? all.leaves : all.held;
  const std::size_t first = before + (is_leaf ? one.leaf : one.held);
  const std::size_t second = before + (is_leaf ? other.leaf : other.held);
  if (place - first < size) {
    place = place - first + second;
  } else if (place - second < size) {
    place = place - second + first;
  }
}

std::size_t LabelShape::exchanged(const Swap& swap, std::size_t place) const {
  for (const Exchange& it : exchanges(swap)) exchange(place, it);
  return place;
}

// What has come to a place did what was done there, so the inner changes are the first.
void LabelShape::exchange_before(Label& label, const Swap& swap) const {
  const std::vector<Exchange> all = exchanges(swap);
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    const MovingChildren& children = moving_children[it->children];
    const MovingChildren::Place &one = children.places[it->one],
                                &other = children.places[it->other];
    for (std::size_t i = 0; i < children.leaves; ++i) {
      const std::uint32_t leaf = moving_leaves[one.leaf + i], by = moving_leaves[other.leaf + i];
      exchange_bits(label, worked_bit(leaf), worked_bit(by));
      exchange_bits(label, ended_bit(leaf), ended_bit(by));
      std::swap(label.after[one.leaf + i], label.after[other.leaf + i]);
    }
    for (std::size_t i = 0; i < children.held; ++i) {
      const std::size_t first = one.held + i, second = other.held + i;
      exchange_bits(label, held_bit(moving_held[first]), held_bit(moving_held[second]));
      const std::size_t before = moving_leaves.size();
      std::swap(label.after[before + first], label.after[before + second]);
    }
  }
}

void LabelShape::exchange_after(Label& label, const Swap& swap) const {
  for (const Exchange& it : exchanges(swap)) {
    for (MovingPlace& place : label.after) {
      std::size_t now = place;
      exchange(now, it);
      place = static_cast<MovingPlace>(now);
    }
  }
}

void LabelShape::set_equals(std::span<const EqualChild> equal, Label& label) const {
  clear(label);
  UnionFind sets(label.after.size());
  const auto unite = [&](std::size_t one, std::size_t other, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sets.unite(one + i, other + i);
  };
  for (const EqualChild& it : equal) {
    const MovingChildren& all = moving_children[it.children];
    const MovingChildren::Place &before = all.places[it.child - 1], &here = all.places[it.child];
    unite(before.leaf, here.leaf, all.leaves);
    unite(moving_leaves.size() + before.held, moving_leaves.size() + here.held, all.held);
  }
  std::vector<MovingPlace> last = label.after;  // of each set; itself: none was there
  std::vector<bool> has_last(last.size());
  for (std::size_t i = 0; i < last.size(); ++i) {
    const std::size_t set = sets.find(i);
    if (has_last[set]) label.after[i] = last[set];
    last[set] = static_cast<MovingPlace>(i);
    has_last[set] = true;
  }
}

Label LabelShape::equals_beside(const Label& equals, std::size_t place) const {
  const auto first_of = [&](std::size_t it) {
    while (equals.after[it] != it) it = equals.after[it];
    return it;
  };
  std::vector<EqualChild> others;
  for (std::size_t i = 0; i < moving_children.size(); ++i) {
    const MovingChildren& all = moving_children[i];
    if (all.leaves + all.held == 0) continue;
    const auto first_place = [&](const MovingChildren::Place& it) {
      return all.leaves > 0 ? it.leaf : moving_leaves.size() + it.held;
    };
    const std::size_t stays = child_with(all, place);
    for (std::size_t child = 1; child < all.places.size(); ++child) {
      if (stays == child || stays == child - 1) continue;
      const bool is_equal =
          first_of(first_place(all.places[child])) == first_of(first_place(all.places[child - 1]));
      if (is_equal) others.push_back({i, child});
    }
  }
  Label label;
  set_equals(others, label);
  return label;
}

std::uint32_t LabelTable::add(const Label& label) {
  scratch_.clear();
  pack_bits(label, scratch_);
  pack_moves(label, scratch_);
  return add(scratch_);
}

void LabelTable::read(std::uint32_t label, Label& into) const {
  std::span<const std::byte> from = packed_[label];
  for (std::size_t bit = 0; !from.empty();) {
    std::uint64_t length = take_number(from);
    if (length == 0) break;
    for (bit += take_number(from); length > 0; --length) into.set(bit++);
  }
  for (std::size_t i = 0; !from.empty();) {
    std::uint64_t length = take_number(from);
    i += take_number(from);
    const std::int64_t far = unfolded(take_number(from));
    for (; length > 0; --length, ++i) {
      into.after[i] = static_cast<MovingPlace>(static_cast<std::int64_t>(i) + far);
    }
  }
}

bool LabelTable::has(std::uint32_t label, std::size_t bit) const {
  std::span<const std::byte> from = packed_[label];
  for (std::size_t end = 0; !from.empty();) {
    const std::uint64_t length = take_number(from);
    if (length == 0) return false;
    const std::size_t begin = end + take_number(from);
    end = begin + length;
    if (bit < end) return begin <= bit;
  }
  return false;
}

}  // namespace lockstep::host
