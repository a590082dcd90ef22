// How the words of a team come to its members: over a network, or simulated.
#pragma once

#include <cstdint>
#include <span>

#include "team/member.h"

namespace lockstep::host {

struct HeardWord {
  static constexpr std::uint32_t kOwnName = 0xffffffff;
  std::uint32_t team = 0;    // its place among the declarations of the run
  std::uint32_t member = 0;  // in TeamDeclaration::others, or kOwnName
  TeamWord word = {};
  Nanoseconds at{0};  // when it was received, on the clock of the run
};

// All calls come from the thread that ticks. None waits, locks or allocates.
class TeamTransport {
 public:
  virtual ~TeamTransport() = default;
  // The next word that has come and was not given yet; false: there is none.
  virtual bool take(HeardWord& into) = 0;
  virtual void say(std::uint32_t team, const TeamWord& word) = 0;
};

}  // namespace lockstep::host
