// The fields of a message, each with all names from the top: "pose.position.x".
#pragma once

#include <string>
#include <vector>

#include "message.hpp"

namespace ros2 {

struct Field {
  enum class Kind {
    Bool,
    Int,
    Double,
    String,
    BoolList,
    IntList,
    DoubleList,
    StringList,
    Time,     // a stamp: its fields follow, and "now" is a value of the whole
    Messages  // of which only the number is known
  };
  std::string path;
  Kind kind;
  std::size_t offset;       // from the beginning of the whole message
  const Member* member;     // of a Time, null
  double min = 0, max = 0;  // of numbers; both 0: any
};

// Wide strings and long doubles are left out: no port can carry them.
std::vector<Field> fields_of(const Members& members, std::size_t offset = 0);

// Null: there is none.
const Field* find_field(const std::vector<Field>& fields, const std::string& path);

}  // namespace ros2
