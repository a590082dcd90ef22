// Writes what was planned: all of it or nothing, and never over a file that is there.
#pragma once

#include <filesystem>
#include <string>

#include "authoring/scaffold/plan.h"
#include "core/problem.h"

namespace lockstep::host {

// A Problem if one of them is there already.
Result<void> check_free(const NewFiles& files);
// Makes the folders, too. After a Problem none of the files is there.
Result<void> write_new(const NewFiles& files);

// Replaces the text of a file, which keeps its permissions: the new text is written beside it, and
// then takes its name. A Problem if it is not `expected` any more.
Result<void> replace_text(const std::filesystem::path& path, const std::string& expected,
                          const std::string& text);

}  // namespace lockstep::host
