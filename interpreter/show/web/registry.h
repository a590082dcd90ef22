// The monitored runs of this user on this machine: a file for each, which nobody else can read,
// since a link may have a token. It is locked as long as its run lives.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

struct RegisteredRun {
  pid_t process = 0;
  std::string link;  // "": it has only a socket, through which it can be asked for a monitor
  std::string tree_file, socket;
};

// In the order of their numbers.
std::vector<RegisteredRun> registered_runs();

// Lists the run of this process as long as the object exists. Where there is no place for it, the
// run is not listed.
class Registration {
 public:
  // `socket`: the path of an AttachSocket, or "".
  Registration(const std::string& tree_file, const std::string& socket);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

  // Where the run may have a socket that was not asked for; "": nowhere.
  static std::string own_socket();
  void set_link(const std::string& link);
  bool is_listed() const { return file_.number() >= 0; }

 private:
  std::string path_;
  std::string tree_file_, socket_;  // absolute
  FileDescriptor file_;
};

}  // namespace lockstep::host
