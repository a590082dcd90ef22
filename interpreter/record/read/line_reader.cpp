#include "record/read/line_reader.h"

#include "base/compression/decompressed.h"

namespace lockstep::host {

LineReader::LineReader(std::istream& in, std::size_t longest) : in_(in), longest_(longest) {
  in_.exceptions(std::ios_base::badbit);  // what a read throws is passed on
}

bool LineReader::next() {
  text_.clear();
  if (!damage_.empty()) return false;
  try {
    return read_line();
  } catch (const CannotDecompress& damage) {
    damage_ = damage.what();
    return false;
  }
}

bool LineReader::read_line() {
  char part[1u << 12u];
  while (true) {
    in_.getline(part, sizeof part);
    const auto count = static_cast<std::size_t>(in_.gcount());
    const bool goes_on = in_.fail() && !in_.eof() && count > 0;
    has_end_ = in_.good();  // gcount() counts it
    if (count == 0 && text_.empty()) return false;
    text_.append(part, has_end_ ? count - 1 : count);
    if (!goes_on) break;
    in_.clear();
    if (is_too_long()) break;
  }
  ++position_.lines;
  size_ = text_.size() + 1;
  position_.bytes += size_;
  return !is_too_long();
}

bool LineReader::go_to(const Position& position) {
  in_.clear();
  damage_.clear();
  position_ = position;
  size_ = 0;
  try {
    return static_cast<bool>(in_.seekg(static_cast<std::streamoff>(position.bytes)));
  } catch (const CannotDecompress& damage) {
    damage_ = damage.what();
    return false;
  }
}

bool LineReader::go_to_line(std::uint64_t byte) {
  if (byte == 0) return go_to({});
  if (!go_to({.bytes = byte - 1, .knows_lines = false})) return false;
  next();  // the rest of the line before
  return damage_.empty() && !is_too_long();
}

std::optional<std::uint64_t> LineReader::size() {
  in_.clear();
  try {
    const auto end = static_cast<std::streamoff>(in_.seekg(0, std::ios_base::end).tellg());
    if (end >= 0) return static_cast<std::uint64_t>(end);
  } catch (const CannotDecompress&) {  // those who read on meet it
  }
  in_.clear();
  return std::nullopt;
}

}  // namespace lockstep::host
