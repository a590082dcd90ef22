// Makes the bytes of a file of the text of a recording, for a format that is made of it. Only the
// writing thread calls it, never a crash handler.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lockstep::host {

class TextEncoder {
 public:
  virtual ~TextEncoder() = default;
  // The bytes for the next text: what a file may end with. "" while it collects more; also called
  // with "" when there is no text for a while. Throws a std::runtime_error if there are none.
  virtual std::string add(std::string_view text) = 0;
  // The bytes that complete the file.
  virtual std::string end() = 0;
};

using MakeEncoder = std::function<std::unique_ptr<TextEncoder>()>;

}  // namespace lockstep::host
