// A new name for a tree, an argument, a barrier, a pool or an entry, at all of its places.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

// The part of the text that would change; null: nothing there has a name that can be changed.
Json prepare_rename(const Question& question);
// Throws a JsonError with the reason why it cannot be done.
Json rename(const Question& question);

}  // namespace lockstep::host
