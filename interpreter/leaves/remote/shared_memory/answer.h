// A leafhost's answer to a call: how the call ended, its result, and the error that the leaf has
// set.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/core/clock.h"
#include "leaves/remote/shared_memory/message.h"

namespace lockstep::host {

enum class Outcome : std::uint8_t { Returned, Threw, TooLarge };

struct Answer {
  Outcome outcome = Outcome::Returned;
  std::uint64_t result = 0;      // a status, the bits of a double, or whether there is an object
  Nanoseconds took{0};           // by the plugin, where there was much to carry; 0: not measured
  std::string_view error = {};   // "" = none
  std::string_view thrown = {};  // as describe_exception() has it
  std::string_view reason = {};  // of a leaf; "" = none
  std::string_view kept = {};    // of a leaf: what it saves
};

inline void write_answer(const Answer& answer, MessageWriter& message) {
  message.put(answer.outcome);
  message.put(answer.result);
  message.put(answer.took);
  message.put_text(answer.error);
  message.put_text(answer.thrown);
  message.put_text(answer.reason);
  message.put_text(answer.kept);
}

// Returns false if the message is invalid.
inline bool read_answer(MessageReader& message, Answer& answer) {
  answer.outcome = message.get<Outcome>();
  answer.result = message.get<std::uint64_t>();
  answer.took = message.get<Nanoseconds>();
  answer.error = message.text();
  answer.thrown = message.text();
  answer.reason = message.text();
  answer.kept = message.text();
  return message.good() && answer.outcome <= Outcome::TooLarge;
}

}  // namespace lockstep::host
