// `lockstep study compare`: two cells of a study, on stdout.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lockstep::host {

// Returns what the command does, and its exit code.
std::function<int()> define_compare(CLI::App& app);

}  // namespace lockstep::host
