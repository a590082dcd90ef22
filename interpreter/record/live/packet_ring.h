// A queue of whole packets from one thread to another: bytes in a ring of fixed size, without
// locks, waiting or system calls. At any moment a packet is in it completely or not at all, so a
// crash handler may take over as the reader. Used by append_file and packet_printer.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "record/packet.h"

namespace lockstep::host {

class PacketRing {
 public:
  // Touches every page at once, so that no tick has to.
  explicit PacketRing(std::size_t size) : bytes_(in_cells(size)) {}

  static std::size_t in_cells(std::size_t size) {
    return (size + kPacketCell - 1) / kPacketCell * kPacketCell;
  }

  // --- for the thread that puts packets in -------------------------------------------------------

  // Returns false if there is no room; then nothing is stored.
  bool push(Packet packet) {
    packet.head.nodes = static_cast<std::uint32_t>(packet.nodes.size());
    packet.head.text = packet.text.size();
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    const std::size_t size = in_cells(packet_size(packet.head));
    if (size > bytes_.size() - (end - begin_.load(std::memory_order_acquire))) return false;
    std::uint64_t at = put(end, &packet.head, sizeof packet.head);
    at = put(at, packet.nodes.data(), packet.nodes.size_bytes());
    put(at, packet.text.data(), packet.text.size());
    end_.store(end + size, std::memory_order_release);
    return true;
  }
  // Only while the ring is empty: nobody reads its bytes then.
  void grow(std::size_t size) {
    if (size > bytes_.size()) bytes_.assign(in_cells(size), '\0');
  }

  std::size_t size() const { return bytes_.size(); }

  // --- for the one thread at a time that takes them out ------------------------------------------

  PacketHead head(std::uint64_t position) const {
    PacketHead head;
    const std::string_view first = bytes(position, sizeof head);
    std::memcpy(&head, first.data(), first.size());
    std::memcpy(reinterpret_cast<char*>(&head) + first.size(), bytes_.data(),
                sizeof head - first.size());
    return head;
  }
  // The bytes from a position on, `count` or, where the ring ends, fewer.
  std::string_view bytes(std::uint64_t position, std::uint64_t count) const {
    const std::size_t at = position % bytes_.size();
    return {bytes_.data() + at, std::min<std::size_t>(count, bytes_.size() - at)};
  }
  // Likewise the changes of nodes. push() has copied whole ones, each to a cell.
  std::span<const NodeChange> nodes(std::uint64_t position, std::uint64_t count) const {
    const std::string_view all = bytes(position, count * sizeof(NodeChange));
    return {reinterpret_cast<const NodeChange*>(all.data()), all.size() / sizeof(NodeChange)};
  }
  // Visits them, and returns the position behind them.
  template <class Visit>  // (const NodeChange&)
  std::uint64_t each_node(std::uint64_t position, std::uint64_t count, Visit visit) const {
    while (count > 0) {
      const auto some = nodes(position, count);
      for (const NodeChange& it : some) visit(it);
      position += some.size_bytes();
      count -= some.size();
    }
    return position;
  }
  // Visits the packets between two positions, each with that of its nodes.
  template <class Visit>  // (std::uint64_t, const PacketHead&)
  void each_packet(std::uint64_t from, std::uint64_t to, Visit visit) const {
    while (from < to) {
      const PacketHead it = head(from);
      visit(from + sizeof it, it);
      from += in_cells(packet_size(it));
    }
  }
  void take_until(std::uint64_t position) { begin_.store(position, std::memory_order_release); }

  // --- for all -----------------------------------------------------------------------------------

  // Positions: bytes so far. Packets begin at multiples of a cell.
  std::uint64_t pushed() const { return end_.load(std::memory_order_acquire); }
  std::uint64_t taken() const { return begin_.load(std::memory_order_acquire); }
  bool empty() const { return taken() == pushed(); }

 private:
  std::uint64_t put(std::uint64_t position, const void* from, std::size_t count) {
    if (count == 0) return position;
    const std::size_t at = position % bytes_.size();
    const std::size_t first = std::min(count, bytes_.size() - at);
    std::memcpy(bytes_.data() + at, from, first);
    if (first < count) {
      std::memcpy(bytes_.data(), static_cast<const char*>(from) + first, count - first);
    }
    return position + count;
  }

  // Aligned so that the two threads do not share a cache line.
  alignas(64) std::atomic<std::uint64_t> end_{0};
  alignas(64) std::atomic<std::uint64_t> begin_{0};
  std::vector<char> bytes_;
};

}  // namespace lockstep::host
