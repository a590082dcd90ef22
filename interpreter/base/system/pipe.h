// Two descriptors, of which one reads what the other writes. No process that is started inherits
// them by itself.
#pragma once

#include <fcntl.h>
#include <sys/socket.h>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

struct Pipe {
  FileDescriptor reading, writing;

  // False, with errno, if there is none.
  bool open() {
    int ends[2];
    return pipe2(ends, O_CLOEXEC) == 0 && take(ends);
  }
  // A pair of sockets of this type: to write to one whose reader is gone can send no signal.
  bool open_sockets(int type) {
    int ends[2];
    return socketpair(AF_UNIX, type | SOCK_CLOEXEC, 0, ends) == 0 && take(ends);
  }

 private:
  bool take(const int (&ends)[2]) {
    reading = FileDescriptor(ends[0]);
    writing = FileDescriptor(ends[1]);
    return true;
  }
};

}  // namespace lockstep::host
