// `lockstep plugin check` of a shared object: child processes load it and examine its leaves, so
// that one that crashes, hangs or exits is named, and the next one is examined after all.
#pragma once

#include <cstddef>
#include <string>

#include "leaves/remote/json_lines/conformance.h"
#include "run/loading/plugins.h"

namespace lockstep::host {

// The end of a pipe to the command in its child: lines for it.
constexpr int kFindings = 3;

// In the command. `options` has the file, the hang limit.
Conformance check_object(const std::string& file, const PluginOptions& options);
// In its child: from this leaf on. Returns the exit code.
int examine_object(const std::string& file, const PluginOptions& options, std::size_t first);

}  // namespace lockstep::host
