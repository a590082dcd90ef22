// The distribution of many numbers in little memory: how many there are in each of 1024 buckets of
// equal width for each power of two, and the least and the largest of each bucket. A quantile is at
// most 1/2048 of itself from the exact one, and exact where a bucket has seen one number only, as
// whole numbers below 2048. A sketch depends on the numbers alone: not on their order, nor on how
// they were split before sketches were added.
//
// The idea is DDSketch's (Masson, Rim, Lee, *DDSketch: A Fast and Fully-Mergeable Quantile Sketch
// with Relative-Error Guarantees*, VLDB 2019). Instead of a logarithm, the first bits of the double
// name its bucket, so that every machine finds the same one.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace lockstep::host {

class QuantileSketch {
 public:
  struct Bucket {
    double low = 0, high = 0;  // that are in it
    std::uint64_t count = 0;
  };

  // The number is finite.
  void add(double value);
  void add(const QuantileSketch& other);
  // False if this bucket cannot be one: it has more than one bucket's numbers.
  bool add(const Bucket& bucket);

  std::uint64_t count() const { return count_; }
  // Those that have numbers, from the lowest.
  std::vector<Bucket> buckets() const;

 private:
  static constexpr unsigned kBits = 10;
  using Page = std::array<Bucket, std::size_t{1} << kBits>;  // a power of two and a sign

  static std::int64_t place_of(double value);
  Bucket& at(std::int64_t place);

  std::map<std::int64_t, Page> pages_;
  std::uint64_t count_ = 0;
};

}  // namespace lockstep::host
