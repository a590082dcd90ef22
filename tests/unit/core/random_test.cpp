#include "base/core/random.h"

#include <catch2/catch.hpp>
#include <set>

using namespace lockstep::host;

TEST_CASE("a seed and a stream give the same numbers on every machine") {
  RandomStream stream(7, 3);
  CHECK(stream.next() == 0x985bf9b957b84680u);
  CHECK(stream.next() == 0xda8a6acfb96d7145u);
  CHECK(stream.next() == 0x726fac4c353d2321u);
  CHECK(RandomStream(7, 3).next_double() == 0.5951534345146863);
}

TEST_CASE("no two streams of neighboring seeds and numbers are alike") {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 64; ++seed)
    for (std::uint64_t number = 0; number < 64; ++number)
      firsts.insert(RandomStream(seed, number).next());
  CHECK(firsts.size() == 64 * 64);
}

TEST_CASE("doubles fill 0 to 1 evenly, without 1") {
  RandomStream stream(1, 1);
  constexpr int kSamples = 100'000;
  int bins[10] = {};
  for (int i = 0; i < kSamples; ++i) {
    const double sample = stream.next_double();
    REQUIRE((sample >= 0 && sample < 1));
    ++bins[static_cast<int>(sample * 10)];
  }
  // Six standard deviations of a bin's count.
  for (const int count : bins) CHECK(std::abs(count - kSamples / 10) < 570);
}
