// The text about the element, attribute or value under the pointer.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

Json hover(const Question& question);

}  // namespace lockstep::host
