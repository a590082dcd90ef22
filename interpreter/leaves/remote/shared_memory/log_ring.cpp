#include "leaves/remote/shared_memory/log_ring.h"

#include <algorithm>
#include <cstring>

#include "base/core/utf8.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

struct Head {
  std::uint32_t size;
  std::uint32_t caller;
  std::int32_t level;
};

void copy_in(LogRing& ring, std::uint64_t at, const void* data, std::size_t size) {
  const std::size_t start = at % LogRing::kSize;
  const std::size_t first = std::min(size, LogRing::kSize - start);
  std::memcpy(ring.bytes.data() + start, data, first);
  std::memcpy(ring.bytes.data(), static_cast<const char*>(data) + first, size - first);
}

void copy_out(const LogRing& ring, std::uint64_t at, void* data, std::size_t size) {
  const std::size_t start = at % LogRing::kSize;
  const std::size_t first = std::min(size, LogRing::kSize - start);
  std::memcpy(data, ring.bytes.data() + start, first);
  std::memcpy(static_cast<char*>(data) + first, ring.bytes.data(), size - first);
}

}  // namespace

bool LogRingWriter::append(std::uint32_t caller, lockstep_log_level level, std::string_view text) {
  const std::string_view cut = utf8_front(text, kLongestLogLine);
  const Head head{static_cast<std::uint32_t>(cut.size()), caller, level};
  const Lock lock(mutex_);
  const std::uint64_t at = ring_.written.load(std::memory_order_relaxed);
  const std::uint64_t used = at - ring_.read.load(std::memory_order_acquire);
  if (used + sizeof head + cut.size() > LogRing::kSize) {
    ring_.lost.fetch_add(1);
    return true;
  }
  copy_in(ring_, at, &head, sizeof head);
  copy_in(ring_, at + sizeof head, cut.data(), cut.size());
  ring_.written.store(at + sizeof head + cut.size(), std::memory_order_release);
  return used > LogRing::kSize / 2;
}

void LogRingReader::drain(const Line& line, std::size_t most) {
  const std::uint64_t end = ring_.written.load(std::memory_order_acquire);
  if (end - read_ > LogRing::kSize) read_ = end;  // not written by us: nothing can be made of it
  while (read_ != end) {
    Head head{};
    const std::uint64_t rest = end - read_;
    if (rest < sizeof head) break;
    copy_out(ring_, read_, &head, sizeof head);
    if (head.size > rest - sizeof head) break;
    text_.resize(head.size);
    copy_out(ring_, read_ + sizeof head, text_.data(), head.size);
    read_ += sizeof head + head.size;
    ring_.read.store(read_, std::memory_order_release);
    line(head.caller, head.level, text_.c_str());
    if (--most == 0) return;
  }
  read_ = end;
  ring_.read.store(read_, std::memory_order_release);
}

}  // namespace lockstep::host
