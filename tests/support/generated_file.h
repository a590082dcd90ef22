// Files of this project that are made from tables of the program: a test says whether one is stale,
// and `./dev generate` runs that test with LOCKSTEP_GENERATE, which writes the file again.
#pragma once

#include <string>

namespace lockstep::host::test {

// The text of a file, by its name from the root of the project.
std::string project_file(const std::string& name);
// The file must have this text.
void check_generated(const std::string& name, const std::string& text);

}  // namespace lockstep::host::test
