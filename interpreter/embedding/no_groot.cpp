// In place of groot.cpp, where Groot2 is left out.
#include "embedding/groot.h"
#include "groot/tree.h"
#include "trace/observer.h"

namespace lockstep::host::embedding {

std::shared_ptr<const GrootTree> groot_of(const Definition&) {
  return std::make_shared<const GrootTree>();
}

Result<std::unique_ptr<Observer>> show_groot(const Tree&, const GrootTree&, const std::string&) {
  return problem("this lockstep was built without Groot2",
                 "./dev build, or cmake with libzmq, -DLOCKSTEP_TOOLS=ON and -DLOCKSTEP_GROOT2=ON");
}

}  // namespace lockstep::host::embedding
