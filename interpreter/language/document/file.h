// Reads a whole file; on failure returns the system's reason. Accepts only a regular file or, if
// the user named it, a pipe: a device could block, never end, or have side effects when it is
// opened.
#pragma once

#include <cstddef>
#include <string>

#include "base/core/problem.h"

namespace lockstep::host {

enum class FileKinds : bool { Regular, RegularOrPipe };

// Reads at most a little more than `limit` bytes, so the caller can tell that the file is too
// large, whatever size the system reports. Blocks, without a timeout, until a pipe's writer is
// done.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::size_t limit,
                                            FileKinds kinds = FileKinds::Regular);

// The same for stdin, unless it is a terminal or another device.
[[nodiscard]] Result<std::string> read_stdin(std::size_t limit);

}  // namespace lockstep::host
