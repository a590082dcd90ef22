// The descriptors that lockstep-leafhost finds open when it serves a plugin, beside 0 (empty), 1
// and 2 (our standard error).
#pragma once

namespace lockstep::host {

struct LeafhostDescriptors {
  static constexpr int kMemory = 3;
  static constexpr int kBell = 4;
  static constexpr int kParent = 5;  // a pidfd of the host: readable when it has ended
};

}  // namespace lockstep::host
