// What a result or a response says about itself, in words: its error codes by the names of their
// constants, and its texts. Example: "FAILED_TO_MAKE_PROGRESS (105): the robot does not move".
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fields.hpp"

namespace ros2 {

// A field is found by its name, so that the type may be any:
//   - a code is an integer with a part of its path that ends with code, error, status, result or
//     state: `error_code`, `error_code.val`. 0 is no error.
//   - a text is a string with a name that ends with msg, message, string, text, reason,
//   description,
//     details, info, error or status; without such a one, the only string of the message.
class ResultWords {
 public:
  ResultWords() = default;
  // Reads the constants from the interface files of the packages. `fields` are those of `message`,
  // and stay.
  ResultWords(const Members& message, const std::vector<Field>& fields);

  // ": CODE (101): text", or "" if the message says nothing.
  std::string text(const void* message) const;

 private:
  struct Code {
    const Field* field;
    std::vector<std::pair<std::string, std::int64_t>> constants;  // of the message that has it
  };

  std::vector<Code> codes_;
  std::vector<const Field*> texts_;
};

}  // namespace ros2
