// Reads the lines of a stream, each with a limited number of bytes. Used by recording_reader.
#pragma once

#include <algorithm>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>

namespace lockstep::host {

class LineReader {
 public:
  // `in` must outlive the reader.
  LineReader(std::istream& in, std::size_t longest);

  // Reads the next line. Returns false at the end, if the line is too long, and if it cannot be
  // decompressed. A line that is too long is counted but not kept.
  bool next();
  // Without its end. May be changed: it is not read again.
  std::string& text() { return text_; }
  // Only the last line can lack its end.
  bool has_end() const { return has_end_; }
  bool is_too_long() const { return text_.size() > longest_; }
  std::size_t longest() const { return longest_; }
  const std::string& damage() const { return damage_; }  // "": there is none

  // How much has been read.
  struct Position {
    std::uint64_t lines = 0, bytes = 0;
    bool knows_lines = true;  // else `lines` is not known
  };
  const Position& position() const { return position_; }
  // The first byte of the last line, or of the next one if that is damaged.
  std::uint64_t begin_of_line() const {
    return damage_.empty() ? position_.bytes - std::min(position_.bytes, size_) : position_.bytes;
  }
  // Continues at an earlier position of this reader. Returns false if the stream cannot seek.
  bool go_to(const Position& position);
  // Continues with the first line that begins at this byte or after it. Likewise.
  bool go_to_line(std::uint64_t byte);
  // The bytes of all lines; none: the stream cannot seek. Go to a place then.
  std::optional<std::uint64_t> size();

 private:
  bool read_line();

  std::istream& in_;
  const std::size_t longest_;
  std::string text_;
  bool has_end_ = true;
  std::string damage_;
  Position position_;
  std::uint64_t size_ = 0;  // bytes of the last line, with its end
};

}  // namespace lockstep::host
