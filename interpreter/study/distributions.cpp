#include "study/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace lockstep {

double normal_quantile(double probability) {
  return quantile(boost::math::normal(), probability);
}

double normal_two_sided(double z) {
  return 2 * cdf(complement(boost::math::normal(), std::abs(z)));
}

std::optional<std::uint64_t> fair_coin_quantile(std::uint64_t throws, double probability) {
  const boost::math::binomial heads(static_cast<double>(throws), 0.5);
  if (cdf(heads, 0) > probability) return std::nullopt;
  // Boost rounds it in a way that a policy chooses; here it is exact whatever that is.
  auto most = static_cast<std::uint64_t>(quantile(heads, probability));
  const auto likelihood = [&](std::uint64_t k) { return cdf(heads, static_cast<double>(k)); };
  while (likelihood(most) > probability) --most;
  while (likelihood(most + 1) <= probability) ++most;
  return most;
}

}  // namespace lockstep
