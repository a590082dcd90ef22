// The functions of distributions that intervals and tests need. Its .cpp is the only file that uses
// Boost.Math.
#pragma once

#include <cstdint>
#include <optional>

namespace lockstep::host {

// The probability that a standard normal number is z or farther from 0.
double normal_two_sided(double z);
// The largest k so that `throws` of a fair coin show at most k heads with at most this probability;
// nothing if even 0 heads are likelier.
std::optional<std::uint64_t> fair_coin_quantile(std::uint64_t throws, double probability);
// The share below which at least `count` of `all` are seen with at most this probability, and the
// one above which at most `count` are. 0 for none and 1 for all.
double least_share(std::uint64_t count, std::uint64_t all, double probability);
double largest_share(std::uint64_t count, std::uint64_t all, double probability);

}  // namespace lockstep::host
