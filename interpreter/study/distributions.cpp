#include "study/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

namespace lockstep::host {
namespace {

// In long double, which is its custom, the library computes constants before main: for every
// command, and valgrind, which has no long double, ends there.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Binomial = boost::math::binomial_distribution<double, InDouble>;

constexpr double kRootTwo = boost::math::constants::root_two<double>();

}  // namespace

double normal_two_sided(double z) {
  const long double x = std::abs(z) / kRootTwo;
  return static_cast<double>(std::erfc(x));
}

std::optional<std::uint64_t> fair_coin_quantile(std::uint64_t throws, double probability) {
  const Binomial heads(static_cast<double>(throws), 0.5);
  if (cdf(heads, 0) > probability) return std::nullopt;
  // Boost rounds it in a way that a policy chooses; here it is exact whatever that is.
  auto most = static_cast<std::uint64_t>(quantile(heads, probability));
  const auto likelihood = [&](std::uint64_t k) { return cdf(heads, static_cast<double>(k)); };
  while (likelihood(most) > probability) --most;
  while (likelihood(most + 1) <= probability) ++most;
  return most;
}

double least_share(std::uint64_t count, std::uint64_t all, double probability) {
  if (count == 0) return 0;
  return Binomial::find_lower_bound_on_p(static_cast<double>(all), static_cast<double>(count),
                                         probability);
}

double largest_share(std::uint64_t count, std::uint64_t all, double probability) {
  if (count == all) return 1;
  return Binomial::find_upper_bound_on_p(static_cast<double>(all), static_cast<double>(count),
                                         probability);
}

}  // namespace lockstep::host
