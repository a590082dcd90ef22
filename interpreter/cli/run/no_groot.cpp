// In place of groot.cpp, where Groot2 is left out.
#include "cli/run/groot.h"

namespace lockstep::host {

Result<std::unique_ptr<GrootListener>> listen_for_groot(const std::string&, const Definition&) {
  return problem("--groot2: this lockstep was built without it",
                 "./dev build, or cmake with libzmq, -DLOCKSTEP_TOOLS=ON and -DLOCKSTEP_GROOT2=ON");
}

}  // namespace lockstep::host
