// What a search keeps of a property while a run goes on: a few bytes, which it copies and compares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lockstep::host {

class Ticker;

class Monitor {
 public:
  enum class Answer : std::uint8_t { Open, Violated };

  virtual ~Monitor() = default;
  virtual const std::string& name() const = 0;
  virtual std::size_t state_size() const = 0;
  // Before the first tick.
  virtual void begin(std::byte* state) const = 0;
  // After each tick. Reads a state of the run as a recording has it: before it is folded.
  virtual Answer step(std::byte* state, Ticker& ticker) const = 0;
  // When the run has ended.
  virtual Answer at_end(const std::byte* state) const = 0;
};

using Monitors = std::vector<std::shared_ptr<const Monitor>>;

}  // namespace lockstep::host
