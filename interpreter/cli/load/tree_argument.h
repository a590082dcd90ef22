// The tree file that a command takes: a path, or the name of an example.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lockstep::host {

// `tree`, which is returned, and --example. `description` is that of the file.
CLI::Option* add_tree_argument(CLI::App& app, std::string& tree, const char* description);

}  // namespace lockstep::host
