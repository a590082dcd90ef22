// Reading a whole file, with the system's reason when that fails. Only a regular one, or, where the
// user has named it, a pipe: a device could block, never end, or do something when it is opened.
#pragma once

#include <cstddef>
#include <string>

#include "core/problem.h"

namespace lockstep {

enum class FileKinds : bool { Regular, RegularOrPipe };

// At most a little more than `limit` bytes, so that the reader of the text sees that it is too
// much, whatever size the system tells. Waits for who writes to a pipe, as long as that takes.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::size_t limit,
                                            FileKinds kinds = FileKinds::Regular);

// The same of stdin, unless it is a terminal or another device.
[[nodiscard]] Result<std::string> read_stdin(std::size_t limit);

}  // namespace lockstep
