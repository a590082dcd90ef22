#include "study/exact_sum.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <span>

namespace lockstep::host {
namespace {

constexpr unsigned kLimbBits = 32;
constexpr std::int64_t kLimbMask = 0xffffffff;
constexpr int kUnit = -1074;  // the exponent of limb 0
constexpr std::uint32_t kMostPending = 1u << 28u;

void propagate(std::span<std::int64_t> limbs) {
  for (std::size_t i = 0; i + 1 < limbs.size(); ++i) {
    limbs[i + 1] += limbs[i] >> kLimbBits;
    limbs[i] &= kLimbMask;
  }
}

}  // namespace

void ExactSum::carry() {
  propagate(limbs_);
  pending_ = 0;
}

void ExactSum::add(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t exponent = (bits >> 52u) & 0x7ffu;
  const std::uint64_t fraction = bits & 0xfffffffffffffu;
  const std::uint64_t mantissa = fraction | (exponent == 0 ? 0 : std::uint64_t{1} << 52u);
  const std::uint64_t place = exponent == 0 ? 0 : exponent - 1;
  const std::size_t limb = place / kLimbBits;
  const auto shift = static_cast<unsigned>(place % kLimbBits);
  const auto low = static_cast<std::int64_t>((mantissa & 0xffffffffu) << shift);
  const auto high = static_cast<std::int64_t>((mantissa >> kLimbBits) << shift);
  const std::int64_t sign = bits >> 63u == 0 ? 1 : -1;
  limbs_[limb] += sign * (low & kLimbMask);
  limbs_[limb + 1] += sign * ((low >> kLimbBits) + (high & kLimbMask));
  limbs_[limb + 2] += sign * (high >> kLimbBits);
  if (++pending_ == kMostPending) carry();
}

void ExactSum::add(const ExactSum& other) {
  ExactSum carried = other;
  carried.carry();
  carry();
  for (std::size_t i = 0; i < kLimbs; ++i) limbs_[i] += carried.limbs_[i];
  carry();
}

ExactSum::Magnitude ExactSum::magnitude() const {
  Magnitude it{.limbs = limbs_};
  propagate(it.limbs);
  it.is_negative = it.limbs.back() < 0;
  if (it.is_negative) {
    for (std::int64_t& limb : it.limbs) limb = -limb;
    propagate(it.limbs);
  }
  it.top = kLimbs - 1;
  while (it.top > 0 && it.limbs[it.top] == 0) --it.top;
  return it;
}

double ExactSum::mean(std::uint64_t count) const {
  const Magnitude it = magnitude();
  // The first 64 bits of the number; the last of them also stands for all that are below.
  std::uint64_t first = 0;
  bool has_more = false;
  std::size_t limb = it.top + 1;
  while (limb > 0 && std::bit_width(first) <= 32) {
    first = first << kLimbBits | static_cast<std::uint64_t>(it.limbs[--limb]);
  }
  int exponent = kUnit + static_cast<int>(limb * kLimbBits);
  if (limb > 0 && std::bit_width(first) < 64) {
    const auto room = 64 - static_cast<unsigned>(std::bit_width(first));
    const auto next = static_cast<std::uint64_t>(it.limbs[--limb]);
    first = first << room | next >> (kLimbBits - room);
    has_more = (next & ((std::uint64_t{1} << (kLimbBits - room)) - 1)) != 0;
    exponent -= static_cast<int>(room);
  }
  while (limb > 0) has_more |= it.limbs[--limb] != 0;
  const double sum = static_cast<double>(first | (has_more ? 1 : 0));
  const double mean = std::ldexp(sum / static_cast<double>(count), exponent);
  return it.is_negative ? -mean : mean;
}

std::string ExactSum::text() const {
  const Magnitude it = magnitude();
  std::size_t low = 0;
  while (low < it.top && it.limbs[low] == 0) ++low;
  if (it.limbs[low] == 0) return "0";
  std::string text = it.is_negative ? "-" : "";
  text += fmt::format("{:x}", it.limbs[it.top]);
  for (std::size_t limb = it.top; limb-- > low;) text += fmt::format("{:08x}", it.limbs[limb]);
  return text + fmt::format("p{}", kUnit + static_cast<int>(low * kLimbBits));
}

std::optional<ExactSum> ExactSum::from(std::string_view text) {
  ExactSum sum;
  if (text == "0") return sum;
  const bool is_negative = text.starts_with('-');
  std::string_view digits =
      text.substr(is_negative ? 1 : 0, text.find('p') - (is_negative ? 1 : 0));
  int exponent = 0;
  const std::string_view end = text.substr(std::min(text.find('p'), text.size() - 1) + 1);
  std::from_chars(end.data(), end.data() + end.size(), exponent);
  auto limb = static_cast<std::size_t>(std::max(exponent - kUnit, 0)) / kLimbBits;
  for (; !digits.empty() && limb < kLimbs; ++limb) {
    const std::size_t first = digits.size() - std::min<std::size_t>(digits.size(), 8);
    std::from_chars(digits.data() + first, digits.data() + digits.size(), sum.limbs_[limb], 16);
    if (is_negative) sum.limbs_[limb] = -sum.limbs_[limb];
    digits = digits.substr(0, first);
  }
  // Whatever else the text has, it is not how a sum is written.
  return sum.text() == text ? std::optional(sum) : std::nullopt;
}

}  // namespace lockstep::host
