// Writes what was planned: all of it or nothing, and never over a file that is there.
#pragma once

#include <filesystem>
#include <string>

#include "author/scaffold/plan.h"
#include "base/core/problem.h"

namespace lockstep::host {

// A Problem if one of them is there already.
Result<void> check_free(const NewFiles& files);
// Makes the folders, too. After a Problem none of the files is there.
Result<void> write_new(const NewFiles& files);

}  // namespace lockstep::host
