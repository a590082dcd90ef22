// The layout of `lockstep fmt`.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

// null: the text is not readable, so it stays as it is.
Json formatting(const Question& question);

}  // namespace lockstep::host
