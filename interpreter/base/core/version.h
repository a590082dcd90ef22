// The version of lockstep. Its .cpp is the only file that is compiled again when it changes.
#pragma once

namespace lockstep::host {

extern const char kVersion[];  // "1.0.0"

}  // namespace lockstep::host
