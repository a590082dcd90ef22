#include "study/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace lockstep {

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

double least_share(std::uint64_t count, std::uint64_t all, double probability) {
  if (count == 0) return 0;
  return boost::math::binomial::find_lower_bound_on_p(static_cast<double>(all),
                                                      static_cast<double>(count), probability);
}

double largest_share(std::uint64_t count, std::uint64_t all, double probability) {
  if (count == all) return 1;
  return boost::math::binomial::find_upper_bound_on_p(static_cast<double>(all),
                                                      static_cast<double>(count), probability);
}

}  // namespace lockstep
