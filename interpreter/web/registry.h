// The monitored runs of this user on this machine: a file for each, which nobody else can read,
// since a link may have a token. It is locked as long as its run lives.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "core/file_descriptor.h"

namespace lockstep {

struct RegisteredRun {
  pid_t process = 0;
  std::string link, tree_file;
};

// In the order of their numbers.
std::vector<RegisteredRun> registered_runs();

// Of this process, as long as it exists. Where there is no place for it, the run is not listed.
class Registration {
 public:
  Registration(const std::string& link, const std::string& tree_file);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  std::string path_;
  FileDescriptor file_;
};

}  // namespace lockstep
