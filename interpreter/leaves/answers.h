// The leaves of a model ask which of several things they do. The answers decide what a run
// is: all combinations in turn, those of a script, or random ones.
#pragma once

#include <cstdint>
#include <vector>

namespace lockstep::host {

class Answers {
 public:
  virtual ~Answers() = default;
  // From 0 to `count` - 1; `count` is at least 1.
  virtual std::uint32_t choose(std::uint32_t count) = 0;
};

// All combinations of the answers in one tick: the tick is done again with the next one.
class Odometer final : public Answers {
 public:
  std::uint32_t choose(std::uint32_t count) override {
    if (count <= 1) return 0;
    if (at_ == digits_.size()) digits_.push_back({0, count});
    return digits_[at_++].value;
  }

  // Before each tick.
  void begin() { at_ = 0; }
  // After it. False: it was the last combination.
  bool next() {
    digits_.resize(at_);
    while (!digits_.empty() && digits_.back().value + 1 == digits_.back().count) digits_.pop_back();
    if (digits_.empty()) return false;
    ++digits_.back().value;
    return true;
  }
  // From the first combination on.
  void start_over() {
    digits_.clear();
    at_ = 0;
  }

 private:
  struct Digit {
    std::uint32_t value, count;
  };
  std::vector<Digit> digits_;
  std::size_t at_ = 0;
};

}  // namespace lockstep::host
