// The fields of a message, each with all names from the top: "pose.position.x".
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "message.hpp"

namespace ros2 {

// A sequence of messages. Its fields are columns: each is a list with a value for every message.
struct Rows {
  std::string path;
  std::size_t offset;    // from the beginning of the whole message
  const Member* member;  // the sequence
};

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
    Time,      // a stamp: its fields follow, and "now" is a value of the whole
    Duration,  // in seconds; its fields follow
    Messages,  // a sequence; its columns follow
    Object     // a whole message, which an entry carries; its fields follow
  };
  std::string path;  // "": the whole
  Kind kind;
  std::size_t offset;       // from the beginning of the whole message; of a column, of its message
  const Member* member;     // of a Time, Duration and Object, null
  double min = 0, max = 0;  // of numbers; both 0: any
  std::shared_ptr<const Rows> rows = {};  // of a column
  const Members* message = nullptr;       // of an Object
};

// Wide strings and long doubles are left out: no port can carry them.
std::vector<Field> fields_of(const Members& members, std::size_t offset = 0);

// Null: there is none.
const Field* find_field(const std::vector<Field>& fields, const std::string& path);

}  // namespace ros2
