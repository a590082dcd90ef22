// Quick fixes: the nearest known word for every "did you mean", and parameters that are missing.
#pragma once

#include "authoring/server/features/feature.h"

namespace lockstep::host {

Json code_actions(const Question& question);

}  // namespace lockstep::host
