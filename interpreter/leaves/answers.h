// The leaves of a model ask which of several things they do. The answers decide what a run is.
#pragma once

#include <cstdint>
#include <span>

namespace lockstep::host {

class Answers {
 public:
  virtual ~Answers() = default;
  // From 0 to `count` - 1; `count` is at least 1. `asker` is a leaf by its number, or behind the
  // leaves a fact.
  virtual std::uint32_t choose(std::uint32_t count, std::uint32_t asker) = 0;
  // The same where each answer has a chance, above 0; they add up to 1, and outlive this. Who looks
  // at all answers needs no chances.
  virtual std::uint32_t draw(std::span<const double> chances, std::uint32_t asker) {
    return choose(static_cast<std::uint32_t>(chances.size()), asker);
  }
};

// Which of these a random number in [0, 1) means.
inline std::uint32_t drawn(std::span<const double> chances, double random) {
  std::uint32_t answer = 0;
  while (answer + 1 < chances.size() && random >= chances[answer]) random -= chances[answer++];
  return answer;
}

}  // namespace lockstep::host
