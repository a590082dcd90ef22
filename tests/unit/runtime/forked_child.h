// A part of a test that ends its process: run in a child, whose end and words are looked at.
#pragma once

#include <functional>
#include <string>

namespace lockstep::host::test {

struct Ended {
  int exit_code = -1;  // -1: not by exit
  int signal = 0;      // that ended it
  std::string said;    // on stderr
};

// Runs `body` in a child of this process, which must have one thread; where it returns, the child
// ends with the exit code 0.
Ended in_child(const std::function<void()>& body);

}  // namespace lockstep::host::test
