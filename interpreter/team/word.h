// What the members of a team say to each other: each says it once in a tick, and it holds until the
// next. It goes over the network as it is here (team/dds/).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/core/resource_set.h"

namespace lockstep::host {

// What a robot uses of the pool that the team shares, and asks for.
struct PoolWord {
  struct Ask {
    std::uint32_t number = 0;  // rises in a run with each ask; 0: none
    bool owns = false;         // it was granted
    std::uint64_t set = 0;     // base/core/resource_set.h

    friend bool operator==(const Ask&, const Ask&) = default;
  };
  // Of the one that decides: an ask of another one is granted.
  struct Answer {
    std::uint64_t run = 0;  // of the one that has asked
    std::uint32_t number = 0;

    friend bool operator==(const Answer&, const Answer&) = default;
  };
  static constexpr std::size_t kMostAnswers = 16;

  std::uint64_t declaration = 0;          // a hash; 0: the tree has no pool of the team
  std::uint32_t term = 0;                 // how often another member has begun to decide
  std::uint32_t decider = 0;              // in this term: its place in the list of members
  std::uint64_t follows = 0;              // its run, whose answers are taken; 0: none yet
  bool has_left = false;                  // the run has ended, and this is its last word
  std::array<Ask, kMostAsked> asks = {};  // one for each node that uses the pool
  std::array<Answer, kMostAnswers> answers = {};
  std::uint32_t answer_count = 0;
};

struct TeamWord {
  std::uint64_t run = 0;          // of its process: random, so that two robots of one name differ
  std::uint64_t number = 0;       // rises with each word of a run
  std::uint64_t declaration = 0;  // a hash of the team as its tree declares it
  std::uint32_t round = 0;        // of the team, that it does or does next; 0: it knows none yet
  std::uint32_t passed = 0;       // the last round that it has completed in this run; 0: none
  bool is_in = false;             // it does that round now
  double progress = 0;            // in it, in [0, 1]
  double period = 0;              // of its ticks, in seconds
  PoolWord pool = {};
};

// Of what the trees of a team must agree in (FNV-1a, 64 bits).
constexpr std::uint64_t hash_of_declaration(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char it : text) hash = (hash ^ static_cast<unsigned char>(it)) * 0x100000001b3;
  return hash;
}

}  // namespace lockstep::host
