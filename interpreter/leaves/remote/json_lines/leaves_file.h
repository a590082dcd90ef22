// The leaves of a program, in a file beside it, for commands that do not run it: its first line,
// and then what it was asked to describe, each with its answer. grip.leaves.json for grip.py.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockstep::host {

std::string leaves_file_of(const std::string& program);

// Its first line; nothing when there is no such file, or none that a program could have said.
std::optional<std::string> read_leaves_file(const std::string& program);

// The answer to a request; nothing when it is not there.
std::optional<std::string> read_description(const std::string& program, std::string_view request);

// The program was changed after its file was written.
bool is_older_than_program(const std::string& program);

}  // namespace lockstep::host
