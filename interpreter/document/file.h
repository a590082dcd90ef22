// Reading a whole file, with the system's reason when that fails. Only a regular one: a device or a
// named pipe could block, never end, or do something when it is opened.
#pragma once

#include <cstddef>
#include <string>

namespace lockstep {

struct FileText {
  std::string text;
  std::string failure;  // "" when the text is there
};

// At most a little more than `limit` bytes, so that the reader of the text sees that it is too
// much, whatever size the system tells.
FileText read_file(const std::string& path, std::size_t limit);

}  // namespace lockstep
