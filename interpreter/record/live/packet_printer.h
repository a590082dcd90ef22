// Turns the packets in a ring into the text of a recording, a piece at a time.
// Async-signal-safe: does not allocate, and writes only to itself and the text, so that another
// printer may start again at the beginning of the ring. Used by append_file.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "record/json_lines.h"
#include "record/live/packet_ring.h"

namespace lockstep::host {

class PacketPrinter {
 public:
  static constexpr std::size_t kLeastRoom = json_lines::kMostAtOnce;  // bytes, for print()

  // Starts before the first packet in the ring.
  explicit PacketPrinter(const PacketRing& ring) : ring_(ring), at_(ring.taken()), finished_(at_) {}

  // The next part of the text that fits into `room`; "" when everything is printed, and before a
  // packet that begins another file.
  std::string_view print(std::span<char> room);
  // The head of that packet; null: there is none. It is printed after pass_part().
  const PacketHead* part() const { return waits_for_part_ ? &head_ : nullptr; }
  void pass_part() {
    waits_for_part_ = false;
    passes_part_ = true;
  }

  // Where in the ring the first packet begins that is not completely printed, and how many bytes of
  // its text are printed.
  std::uint64_t finished() const { return finished_; }
  std::uint64_t unfinished_text() const { return unfinished_text_; }

 private:
  bool begin_packet();
  void end_packet();
  char* put_piece(char* to, const char* end);
  char* put_opening(char* to);
  char* put_nodes(char* to, const char* end);
  char* put_text(char* to, const char* end);

  const PacketRing& ring_;
  std::uint64_t at_;
  std::uint64_t finished_;
  std::uint64_t unfinished_text_ = 0;

  // The rest of the packet that is being printed.
  bool in_packet_ = false;
  bool waits_for_part_ = false, passes_part_ = false;
  bool opening_left_ = false;
  std::uint64_t nodes_left_ = 0, text_left_ = 0;
  PacketHead head_ = {};
};

}  // namespace lockstep::host
