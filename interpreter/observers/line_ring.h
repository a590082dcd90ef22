// A queue of whole lines from one thread to another: bytes in a ring of fixed size, without locks,
// waiting or system calls. A line is in it as a whole or not at all, whenever anybody looks: so a
// crash handler may take over as the reader. Used by append_file.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace lockstep {

class LineRing {
 public:
  // The bytes are written to at once, so that no tick is the first to touch a page.
  explicit LineRing(std::size_t size) : bytes_(size) {}

  // --- for the thread that puts lines in
  // -----------------------------------------------------------

  // False: there is no room, nothing was put in.
  bool push(std::string_view lines) {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (lines.size() > bytes_.size() - (end - begin_.load(std::memory_order_acquire))) return false;
    const std::size_t at = end % bytes_.size();
    const std::string_view first = lines.substr(0, bytes_.size() - at);
    std::memcpy(bytes_.data() + at, first.data(), first.size());
    std::memcpy(bytes_.data(), first.data() + first.size(), lines.size() - first.size());
    end_.store(end + lines.size(), std::memory_order_release);
    return true;
  }
  // Only while the ring is empty: nobody reads its bytes then.
  void grow(std::size_t size) {
    if (size > bytes_.size()) bytes_.assign(size, '\0');
  }
  std::size_t size() const { return bytes_.size(); }

  // --- for the one thread at a time that takes them out
  // --------------------------------------------

  // Whole lines, in two pieces where they go over the end of the ring.
  struct Pieces {
    std::string_view first, second;
  };
  Pieces front() const {
    const std::uint64_t begin = taken();
    const auto count = static_cast<std::size_t>(pushed() - begin);
    if (count == 0) return {};
    const std::size_t at = begin % bytes_.size();
    const std::size_t until_end = std::min(count, bytes_.size() - at);
    return {{bytes_.data() + at, until_end}, {bytes_.data(), count - until_end}};
  }
  void take(std::size_t count) { begin_.store(taken() + count, std::memory_order_release); }

  // --- for all
  // -------------------------------------------------------------------------------------

  // Bytes so far.
  std::uint64_t pushed() const { return end_.load(std::memory_order_acquire); }
  std::uint64_t taken() const { return begin_.load(std::memory_order_acquire); }
  bool empty() const { return taken() == pushed(); }

 private:
  std::vector<char> bytes_;
  // Apart, so that the two threads do not share a cache line.
  alignas(64) std::atomic<std::uint64_t> end_{0};
  alignas(64) std::atomic<std::uint64_t> begin_{0};
};

}  // namespace lockstep
