// The ports of 'echo', in the order of its table.
#pragma once

#include <cstdint>

enum EchoPort : std::uint32_t {
  kBoolIn,
  kIntIn,
  kDoubleIn,
  kStringIn,
  kListIn,
  kBoolOut,
  kIntOut,
  kDoubleOut,
  kStringOut,
  kListOut,
  kRandom,
  kProcess,
  kSeen,
  kSpeak,
  kGrow,
  kIntListIn,
  kBoolListIn,
  kStringListIn,
  kNumberIn,
  kIntListOut,
  kBoolListOut,
  kStringListOut,
  kNumberOut
};
