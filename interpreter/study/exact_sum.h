// The sum of doubles without rounding: the same whatever their order, so that sums of parts add up
// to the sum of the whole. A fixed-point number as wide as all doubles (U. Kulisch, *Advanced
// Arithmetic for the Digital Computer*, 2002), in limbs of 32 bits whose carries wait.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep::host {

class ExactSum {
 public:
  // The number is finite.
  void add(double value);
  void add(const ExactSum& other);

  // The sum divided by `count`: rounded once for the sum, once for the quotient.
  double mean(std::uint64_t count) const;

  // The one text of this sum: "-1f8p-1074" is -0x1f8 * 2^-1074; "0".
  std::string text() const;
  // None: no sum has this text.
  static std::optional<ExactSum> from(std::string_view text);

 private:
  // 2^-1074 is the unit of limb 0. More than 2^64 of the largest double fit.
  static constexpr std::size_t kLimbs = 69;
  using Limbs = std::array<std::int64_t, kLimbs>;

  void carry();
  // Without the sign: each limb is from 0 to 2^32 - 1.
  struct Magnitude {
    Limbs limbs = {};
    bool is_negative = false;
    std::size_t top = 0;  // the highest limb that is not 0; 0 if none is
  };
  Magnitude magnitude() const;

  Limbs limbs_ = {};
  std::uint32_t pending_ = 0;  // additions since the last carry
};

}  // namespace lockstep::host
