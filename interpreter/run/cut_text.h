// What a run says that is taken to be cut: see LoopOptions::cuts.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/tree.h"

namespace lockstep::host {

// "cut: the process ends here and is resumed; 'Main/arm' starts again". `leaves`: in Tree::leaves.
std::string cut_text(const Tree& tree, std::span<const std::uint32_t> leaves);

}  // namespace lockstep::host
