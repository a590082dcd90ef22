// In place of mcap_recording.cpp, where the tools are left out.
#include "cli/run/mcap_recording.h"

namespace lockstep::host {

MakeEncoder mcap_recording(bool) {
  return {};
}

}  // namespace lockstep::host
