// What the members of a team say to each other: each says it once in a tick, and it holds until the
// next. It goes over the network as it is here (team/dds/).
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep::host {

struct TeamWord {
  std::uint64_t run = 0;          // of its process: random, so that two robots of one name differ
  std::uint64_t number = 0;       // rises with each word of a run
  std::uint64_t declaration = 0;  // a hash of the team as its tree declares it
  std::uint32_t round = 0;        // of the team, that it does or does next; 0: it knows none yet
  std::uint32_t passed = 0;       // the last round that it has completed in this run; 0: none
  bool is_in = false;             // it does that round now
  double progress = 0;            // in it, in [0, 1]
  double period = 0;              // of its ticks, in seconds
};

// Of what the trees of a team must agree in (FNV-1a, 64 bits).
constexpr std::uint64_t hash_of_declaration(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char it : text) hash = (hash ^ static_cast<unsigned char>(it)) * 0x100000001b3;
  return hash;
}

}  // namespace lockstep::host
