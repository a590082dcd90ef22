// The elements of a file as an outline, and what can be folded.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

Json document_symbols(const Question& question);
Json folding_ranges(const Question& question);

}  // namespace lockstep::host
