// The tree file that a command takes: a path, or the name of an example.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lockstep::host {

enum class TreeFile : std::uint8_t { OfProject, MayLack };

// `tree`, which is returned, and --example. `description` is that of the file. OfProject: without
// one, it is the main file of the project, and an error if that has none.
CLI::Option* add_tree_argument(CLI::App& app, std::string& tree, const char* description,
                               TreeFile otherwise = TreeFile::OfProject);

}  // namespace lockstep::host
