#include "record/live/packet_printer.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {

std::string_view PacketPrinter::print(std::span<char> room) {
  char* const end = room.data() + room.size();
  char* to = room.data();
  while (end - to >= static_cast<std::ptrdiff_t>(kLeastRoom) && (in_packet_ || begin_packet())) {
    char* const next = put_piece(to, end);
    unfinished_text_ += static_cast<std::uint64_t>(next - to);
    to = next;
    if (nodes_left_ == 0 && text_left_ == 0) end_packet();
  }
  return {room.data(), static_cast<std::size_t>(to - room.data())};
}

bool PacketPrinter::begin_packet() {
  const std::uint64_t pushed = ring_.pushed();
  if (at_ == pushed) return false;
  head_ = ring_.head(at_);
  // Only if a plugin has written over it; a crash handler must come to an end all the same.
  if (head_.text > pushed - at_ || packet_size(head_) > pushed - at_) {
    at_ = finished_ = pushed;
    return false;
  }
  waits_for_part_ = head_.begins_part != 0 && !std::exchange(passes_part_, false);
  if (waits_for_part_) return false;
  in_packet_ = opening_left_ = true;
  nodes_left_ = head_.nodes;
  text_left_ = head_.text;
  at_ += sizeof head_;
  return true;
}

void PacketPrinter::end_packet() {
  in_packet_ = false;
  finished_ += PacketRing::in_cells(packet_size(head_));
  at_ = finished_;
  unfinished_text_ = 0;
}

char* PacketPrinter::put_piece(char* to, const char* end) {
  if (opening_left_) return put_opening(to);
  return nodes_left_ > 0 ? put_nodes(to, end) : put_text(to, end);
}

char* PacketPrinter::put_opening(char* to) {
  opening_left_ = false;
  if (head_.lost > 0) to = json_lines::put_lost(to, head_.lost, head_.lost_from);
  if (head_.is_tick != 0) to = json_lines::put_tick(to, head_.tick, Nanoseconds(head_.time));
  return to;
}

char* PacketPrinter::put_nodes(char* to, const char* end) {
  const auto room = static_cast<std::size_t>(end - to);
  const bool first = nodes_left_ == head_.nodes;
  const auto put = json_lines::put_nodes({to, room}, ring_.nodes(at_, nodes_left_), first);
  nodes_left_ -= put.count;
  at_ += put.count * sizeof(NodeChange);
  return put.end;
}

char* PacketPrinter::put_text(char* to, const char* end) {
  const std::uint64_t fit = std::min(text_left_, static_cast<std::uint64_t>(end - to));
  const std::string_view piece = ring_.bytes(at_, fit);
  at_ += piece.size();
  text_left_ -= piece.size();
  return std::copy(piece.begin(), piece.end(), to);
}

}  // namespace lockstep::host
