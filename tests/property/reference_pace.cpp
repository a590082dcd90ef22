#include "property/reference_pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "property/reference_node.h"

namespace lockstep::host::test {
namespace {

constexpr double kNoDifference = 1e-9;

}  // namespace

// "∅·f = f, F·∅ = F"
double product_of(double given, double asked) {
  if (given == kNothingAsked || asked == kNothingAsked) return given + asked;
  return given * asked;
}

// "At a leaf ∅ is 1."
double or_full(double given) {
  return given == kNothingAsked ? 1 : given;
}

// c, E and r of the law.
void ReferencePacer::learn(const Child& child, Paced& it, double seconds) const {
  if (!child.takes_part) {
    it = Paced();
    return;
  }
  if (child.was_ticked) {
    const double g = std::min(1.0, child.node->taken(1) / or_full(given_));
    it.counts = plan_.reaction > 0 ? std::max(g, it.counts - seconds / plan_.reaction) : g;
    it.full += it.counts * seconds;
  }
  const bool is_known = it.full > 0 && child.reached - it.e0 > kNoDifference;
  it.rate = is_known ? (child.reached - it.e0) / it.full : 0;
}

void ReferencePacer::tick(const std::vector<Child>& all, double limit, bool asks, double given,
                          Nanoseconds now, bool begins) {
  const Nanoseconds until = until_ >= last_ ? until_ : now;
  const double seconds = begins ? 0 : to_seconds(until - last_);
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].is_guard) continue;
    learn(all[i], children_[i], seconds);
    if (children_[i].rate > 0) known.push_back(i);
  }
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : known) slowest = std::min(slowest, children_[i].rate);
  const double a = plan_.reaction * slowest;
  const auto T = [&](std::size_t i) {
    return std::max(0.0, limit - all[i].reached) / children_[i].rate;
  };
  const auto U = [&](std::size_t i) {
    return (std::max(0.0, limit - all[i].reached) + a) / children_[i].rate;
  };
  double L = 0, M = 0;
  for (const std::size_t i : known) L = std::max(L, T(i)), M = std::max(M, U(i));
  for (std::size_t i = 0; i < all.size(); ++i) {
    Paced& it = children_[i];
    if (all[i].is_guard || all[i].is_held) continue;
    double f = 1;
    if (asks && it.rate > 0) {
      f = std::max({L <= kNoDifference ? 0 : T(i) / L, M <= kNoDifference ? 0 : U(i) / M, 0.01});
    }
    if (f == 1 || std::abs(f - it.told) >= 0.05 * it.told) it.told = f;
    it.given = product_of(given, asks ? it.told : kNothingAsked);
  }
  last_ = now;
  until_ = Nanoseconds(-1);
  given_ = given;
}

}  // namespace lockstep::host::test
