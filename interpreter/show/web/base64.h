// Bytes as text that stands in any page.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace lockstep::host {

// Encodes bytes as they come.
class Base64 {
 public:
  using Sink = std::function<void(std::string_view)>;

  explicit Base64(Sink sink) : sink_(std::move(sink)) {}

  void add(std::string_view bytes);
  // No bytes follow. Then the sink has the whole text.
  void finish();

 private:
  void add_group(std::string_view bytes);

  const Sink sink_;
  std::string rest_;  // fewer bytes than the three that make four letters
  std::string text_;
};

}  // namespace lockstep::host
