#include "leaves/remote/shared_memory/channel.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/core/running_time.h"
#include "base/system/futex.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMagic = 0x31306b6c6b636f6cu;
constexpr std::size_t kPage = 4096;
constexpr std::size_t kFirstMapping = std::size_t{64} << 10;
constexpr Nanoseconds kLongestSpin = std::chrono::microseconds(50);
constexpr Nanoseconds kShortestSpin = std::chrono::microseconds(1);
constexpr unsigned kWaitsPerTry = 64;
constexpr Nanoseconds kLongestSleep = std::chrono::seconds(1);
constexpr std::uint32_t kNobody = 2;  // whose turn it is when there is no other side any more

void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// With one processor, spinning keeps the other side from answering.
Nanoseconds useful_spin_time() {
  cpu_set_t set;
  const bool known = sched_getaffinity(0, sizeof set, &set) == 0;
  return known && CPU_COUNT(&set) > 1 ? kLongestSpin : Nanoseconds(0);
}

}  // namespace

std::size_t Channel::message_offset() {
  return (sizeof(Control) + kPage - 1) / kPage * kPage;
}

int Channel::create_memory() {
  const int memory = memfd_create("lockstep-leafhost", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (memory < 0) return -1;
  const bool sized = ftruncate(memory, static_cast<off_t>(message_offset() + kLargest)) == 0;
  if (sized && pwrite(memory, &kMagic, sizeof kMagic, offsetof(Control, magic)) == sizeof kMagic &&
      fcntl(memory, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0) {
    return memory;
  }
  close(memory);
  return -1;
}

bool Channel::open(int memory, Side side) {
  struct stat info {};
  const auto whole = static_cast<off_t>(message_offset() + kLargest);
  if (fstat(memory, &info) != 0 || info.st_size != whole) return false;
  const auto map = [&](std::size_t size, std::size_t offset) {
    void* const at =
        mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, memory, static_cast<off_t>(offset));
    return at == MAP_FAILED ? nullptr : at;
  };
  control_ = static_cast<Control*>(map(message_offset(), 0));
  if (control_ == nullptr || control_->magic != kMagic) return false;
  message_ = static_cast<std::byte*>(map(kFirstMapping, message_offset()));
  mapped_ = message_ == nullptr ? 0 : kFirstMapping;
  side_ = side;
  longest_spin_ = useful_spin_time();
  spin_time_ = longest_spin_;
  return message_ != nullptr;
}

Channel::~Channel() {
  if (message_ != nullptr) munmap(message_, mapped_);
  if (control_ != nullptr) munmap(control_, message_offset());
}

bool Channel::reserve(std::size_t size) {
  if (size <= mapped_) return true;
  const std::size_t wanted = std::bit_ceil(size);
  void* const moved = mremap(message_, mapped_, wanted, MREMAP_MAYMOVE);
  if (moved == MAP_FAILED) return false;
  message_ = static_cast<std::byte*>(moved);
  mapped_ = wanted;
  return true;
}

void Channel::send(std::span<const std::byte> message) {
  // An empty message is invalid: without memory we send one, and the other side ends.
  const bool fits = message.size() <= kLargest && reserve(message.size());
  if (fits && !message.empty()) std::memcpy(message_, message.data(), message.size());
  control_->length.store(fits ? message.size() : 0, std::memory_order_relaxed);
  const auto other = 1 - static_cast<std::uint32_t>(side_);
  control_->turn.store(other);
  if (control_->sleeps[other].exchange(0) != 0) futex_wake(control_->turn);
}

bool Channel::is_mine() const {
  return control_->turn.load() == static_cast<std::uint32_t>(side_);
}

bool Channel::spin_until(Nanoseconds end, const std::atomic<bool>& gone) const {
  do {
    for (int look = 0; look < 32; ++look) {
      if (is_mine()) return true;
      relax();
    }
  } while (!gone.load(std::memory_order_relaxed) && monotonic_now() < end);
  return false;
}

// Spinning that does not help, because the other side sleeps or has no processor, keeps it from
// getting one: then it becomes shorter, but for a try now and then.
bool Channel::spin(const std::atomic<bool>& gone) {
  if (is_mine()) return true;
  if (longest_spin_ == Nanoseconds(0)) return false;
  if (++waits_ % kWaitsPerTry == 0) spin_time_ = longest_spin_;
  const bool helped = spin_until(monotonic_now() + spin_time_, gone);
  spin_time_ =
      helped ? std::min(spin_time_ * 2, longest_spin_) : std::max(spin_time_ / 2, kShortestSpin);
  return helped;
}

Channel::Wait Channel::wait(std::optional<Nanoseconds> limit, const std::atomic<bool>& gone) {
  if (spin(gone)) return Wait::Received;
  const Nanoseconds slice = limit ? RunningTime::interval_for(*limit) : kLongestSleep;
  RunningTime time(slice, monotonic_now());
  Nanoseconds waited{0};
  auto& sleeps = control_->sleeps[static_cast<std::uint32_t>(side_)];
  for (;;) {
    sleeps.store(1);
    const std::uint32_t turn = control_->turn.load();
    if (turn == static_cast<std::uint32_t>(side_)) break;
    if (gone.load()) return Wait::Given_up;
    waited += time.look(monotonic_now());
    if (limit && waited >= *limit) return Wait::Late;
    futex_wait(control_->turn, turn, slice);
  }
  sleeps.store(0);
  return Wait::Received;
}

void Channel::wake() {
  auto other = 1 - static_cast<std::uint32_t>(side_);
  control_->turn.compare_exchange_strong(other, kNobody);
  futex_wake(control_->turn);
}

std::optional<std::span<const std::byte>> Channel::received() {
  const std::uint64_t length = control_->length.load(std::memory_order_relaxed);
  if (length == 0 || length > kLargest || !reserve(length)) return std::nullopt;
  copy_.assign(message_, message_ + length);
  return copy_;
}

}  // namespace lockstep::host
