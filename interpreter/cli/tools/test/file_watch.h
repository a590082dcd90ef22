// Waits for changes of files, for --watch.
#pragma once

#include <string>
#include <vector>

namespace lockstep::host {

// Until a file in the folders of these paths, or below them, has changed. False: a signal came.
bool wait_for_change(const std::vector<std::string>& paths);

}  // namespace lockstep::host
