#include "engine/run_view.h"

#include "engine/tree.h"

namespace lockstep::host {

RunView::RunView(const Tree& tree, Blackboard& board)
    : tree_(tree), nodes_(tree.nodes.data()), board_(board), state_(tree) {}

}  // namespace lockstep::host
