// The documents and example trees that are installed with the program; in a build directory, those
// of its sources.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockstep::host {

// Empty when they are not installed.
std::filesystem::path documents_directory();
std::filesystem::path examples_directory();

// The names of the example trees, sorted: "door_pulling", "paper/example6".
std::vector<std::string> example_names();
std::filesystem::path example_file(const std::string& name);

}  // namespace lockstep::host
