// Which start of the machine this is.
#pragma once

#include <fstream>
#include <string>

namespace lockstep::host {

// Another one after each start, the same for all processes until then; "" if the system has none.
inline std::string boot_id() {
  std::string id;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
  return id;
}

}  // namespace lockstep::host
