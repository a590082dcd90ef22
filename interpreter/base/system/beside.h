// What every file that replaces another one needs: a new file in the same directory, and what it
// keeps of the old one.
#pragma once

#include <sys/stat.h>

#include <string>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

struct BesideFile {
  FileDescriptor file =
      FileDescriptor();  // open for appending; closed, with errno, if it cannot be made
  std::string name = {};
};

// A name in the directory of `path` that ends with the process, the attempt and the ending.
std::string name_beside(const std::string& path, int attempt, const char* ending);
// A new file in the directory of `path`, with this ending. `mode` as of open().
BesideFile open_beside(const std::string& path, const char* ending, mode_t mode);

enum class Kept : bool { NotTheOwner, All };

// Gives the open file the owner, the mode, the access control list, the label and the user's
// attributes of the file with that name, as far as this process may. Without the owner, nobody may
// do more than with both files. Async-signal-safe.
Kept keep_properties(const char* path, const struct stat& old, int file) noexcept;

}  // namespace lockstep::host
