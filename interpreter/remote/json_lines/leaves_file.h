// The leaves of a program, in a file beside it: its first line, for commands that do not run it.
// grip.leaves.json for grip.py.
#pragma once

#include <optional>
#include <string>

namespace lockstep::host {

std::string leaves_file_of(const std::string& program);

// Its first line; nothing when there is no such file, or none that a program could have said.
std::optional<std::string> read_leaves_file(const std::string& program);

// The program was changed after its file was written.
bool is_older_than_program(const std::string& program);

}  // namespace lockstep::host
