// What is reported of a run that was cut, or that is taken to be cut: see LoopOptions::cuts.
#pragma once

#include <span>
#include <string>

#include "engine/cut.h"
#include "engine/tree.h"

namespace lockstep::host {

// "; 'Main/left' continues at 0.42; 'Main/right' starts again"
std::string what_leaves_do(std::span<const CutLeaf> cut, const Tree& tree);
// "cut: the process ends here and is resumed", and that.
std::string cut_text(std::span<const CutLeaf> cut, const Tree& tree);

}  // namespace lockstep::host
