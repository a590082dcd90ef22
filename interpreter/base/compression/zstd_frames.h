// Compresses a text, piece by piece, as zstd frames (RFC 8878). The bytes of each piece end a
// block, so that a reader gets all text of a file that is cut, up to the last whole piece. A frame
// ends with the first piece after kFrame bytes of text: a reader may begin at each of them. It has
// a checksum of its text. Async-signal-safe, where it does not say that it allocates. Used by
// append_file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/compression/seek_table.h"

namespace lockstep::host {

class ZstdFrames {
 public:
  static constexpr std::size_t kFrame = 256u << 10;  // bytes of text

  // For pieces of at most so many bytes. Allocates all memory. Throws a std::runtime_error if there
  // is no libzstd.
  explicit ZstdFrames(std::size_t longest_piece);

  // The bytes of the file for the next piece. Valid until the next call.
  std::string_view add(std::string_view piece);
  // The bytes that end the frame; "" if none is open. More may be added, in another frame.
  std::string_view end();
  // Belongs behind the last frame, and says where each begins. Allocates; "" if not all are known.
  std::string table() const;
  // Makes room for the next frames in the table. Allocates. Without it, there is no table.
  void make_room();
  // A crash has left add(): nothing of its piece is in the file. Call end() before more is added.
  bool was_left() const { return is_adding_; }

 private:
  void begin_frame();
  void end_frame();

  std::vector<char> workspace_;
  std::vector<char> bytes_;
  std::vector<char> text_;  // of the open frame, for its checksum: zstd's own is lost in a crash
  void* stream_ = nullptr;  // a ZSTD_CStream in the workspace
  FrameSize in_frame_;      // no text: no frame is open
  std::vector<FrameSize> sizes_;
  bool knows_sizes_ = true;  // of all frames
  volatile bool is_adding_ = false;
};

}  // namespace lockstep::host
