#include "base/core/version.h"

namespace lockstep::host {

const char kVersion[] = LOCKSTEP_VERSION;

}  // namespace lockstep::host
