// A file that one process at a time has: an empty one, which is removed in the end.
#pragma once

#include <string>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

class LockFile {
 public:
  // What a process left that was killed is taken over. Where there can be no such file, or no lock,
  // nothing is held.
  explicit LockFile(std::string path);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  // Another process has it.
  bool is_elsewhere() const { return is_elsewhere_; }

 private:
  const std::string path_;
  FileDescriptor file_;
  bool is_elsewhere_ = false;
};

}  // namespace lockstep::host
