// A seeded stream of random numbers: SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom
// number generators", OOPSLA 2014). Eight bytes of state, the same sequence on every machine.
// Good for simulated noise; not for secrets.
#pragma once

#include <cstdint>

namespace lockstep::host {

class RandomStream {
 public:
  // Streams of one seed with different numbers are independent of each other.
  RandomStream(std::uint64_t seed, std::uint64_t stream)
      : state_(mix(seed) ^ mix(stream + 0x9e3779b97f4a7c15u)) {}

  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15u); }

  // Uniform in [0, 1), 53 bits.
  double next_double() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace lockstep::host
