// What a program and a plugin share by reference.
#pragma once

#include <memory>
#include <string>

struct Driver {
  using Ptr = std::shared_ptr<Driver>;
  std::string name;
  int used = 0;
};
struct Way {
  int length = 0;
};
