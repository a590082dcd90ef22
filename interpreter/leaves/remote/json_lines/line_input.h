// Lines from a descriptor, of bounded length. Nothing waits in here.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace lockstep::host {

class LineInput {
 public:
  static constexpr std::size_t kLongest = std::size_t{1} << 20;

  // Takes what there is to read, at most a part of it. End: there will be no more.
  enum class Filled { Some, Nothing, End };
  Filled fill(int descriptor);
  // The next whole line, without its end, or nothing.
  bool next(std::string& line);
  // The same without taking it: of the whole lines from `place` on, which is 0 for all. Moves on.
  bool look(std::size_t& place, std::string& line) const;
  // There is more than the longest line without an end.
  bool is_too_long() const { return text_.size() - begin_ > kLongest && scanned_ == text_.size(); }
  // The last line has no end.
  bool has_rest() const { return begin_ < text_.size(); }

 private:
  std::string text_;
  std::size_t begin_ = 0;    // of what was not taken yet
  std::size_t scanned_ = 0;  // no line ends before it
};

}  // namespace lockstep::host
