#include "base/terminal/outlet.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <new>
#include <string>
#include <thread>
#include <utility>

#include "base/core/clock.h"
#include "base/system/descriptors.h"
#include "base/system/mutex.h"
#include "base/system/own_thread.h"

namespace lockstep::host {
namespace {

const char* text_of_reason(int reason) {
  return reason == 0 ? "no process read them" : strerrordesc_np(reason);
}

std::uint64_t lines_of(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

struct Outlet::State {
  enum class Mode : std::uint8_t { Direct, Queued, Closed };
  // Messages that are not written yet. No room: lines that came while it was full.
  struct Batch {
    std::string picture;  // before the text
    std::string text;
    std::uint64_t lines = 0;
    std::uint64_t without_room = 0;

    void clear() {
      picture.clear();
      text.clear();
      lines = without_room = 0;
    }
    std::uint64_t all_lines() const { return lines + without_room; }
  };

  explicit State(int descriptor) : file(descriptor) {}
  void pass_on(const Batch& batch);
  bool tell_gap();
  void lose(std::uint64_t count, int why);
  void write_until_stopped();
  bool is_idle() const { return done == said; }
  bool waits() const LOCKSTEP_REQUIRES(mutex) { return mode == Mode::Queued && !is_idle(); }

  const int file;
  Mutex mutex;
  Mode mode LOCKSTEP_GUARDED_BY(mutex) = Mode::Direct;
  Batch waiting LOCKSTEP_GUARDED_BY(mutex);
  Batch passing;  // changed under the lock, which the thread needs not to read it
  bool stopping LOCKSTEP_GUARDED_BY(mutex) = false;
  std::condition_variable wake;
  std::thread thread;
  std::atomic<std::uint64_t> said{0}, done{0};  // how often; done: with or without success

  Loss gap;  // not reported to the reader yet; used by the writing thread
  std::atomic<std::uint64_t> lost{0};
  std::atomic<int> reason{0};
};

void Outlet::State::lose(std::uint64_t count, int why) {
  if (count == 0) return;
  gap = {gap.lines + count, why};
  lost += count;
  reason = why;
}

bool Outlet::State::tell_gap() {
  if (gap.lines == 0) return true;
  std::array<char, 200> note;
  const int size =
      std::snprintf(note.data(), note.size(), "lockstep: warning: %ju %s lost here: %s\n",
                    std::uintmax_t{gap.lines}, gap.lines == 1 ? "line is" : "lines are",
                    text_of_reason(gap.reason));
  if (!write_all(file, {note.data(), static_cast<std::size_t>(size)})) return false;
  gap = {};
  return true;
}

void Outlet::State::pass_on(const Batch& batch) {
  if (!tell_gap() || !write_all(file, batch.picture) || !write_all(file, batch.text)) {
    lose(batch.lines, errno);
  }
  if (batch.without_room == 0) return;
  lose(batch.without_room, 0);
  tell_gap();
}

void Outlet::State::write_until_stopped() {
  Lock lock(mutex);
  while (true) {
    while (is_idle() && !stopping) lock.wait(wake);
    if (is_idle() || mode == Mode::Closed) return;
    std::swap(passing, waiting);
    const std::uint64_t last = said;
    lock.unlock();
    pass_on(passing);
    lock.lock();
    passing.clear();
    done = last;
  }
}

Outlet::Outlet(int file) : state_(std::make_shared<State>(file)) {}
Outlet::~Outlet() = default;

int Outlet::file() const {
  return state_->file;
}

void Outlet::say(std::string_view lines) noexcept {
  State& state = *state_;
  const Lock lock(state.mutex);
  State::Batch& batch = state.waiting;
  if (state.mode == State::Mode::Closed) {
    state.lost += lines_of(lines);
    return;
  }
  if (state.mode == State::Mode::Direct) {
    if (!state.tell_gap() || !write_all(state.file, lines)) state.lose(lines_of(lines), errno);
    return;
  }
  if (batch.text.size() + lines.size() > kRoom) {
    batch.without_room += lines_of(lines);
  } else {
    batch.text += lines;
    batch.lines += lines_of(lines);
  }
  ++state.said;
  state.wake.notify_one();
}

bool Outlet::show(std::string_view picture) noexcept {
  State& state = *state_;
  const Lock lock(state.mutex);
  if (state.mode == State::Mode::Direct) return write_all(state.file, picture);
  if (state.mode == State::Mode::Closed || !state.is_idle()) return false;
  try {
    state.waiting.picture = picture;
  } catch (const std::bad_alloc&) {
    return false;
  }
  ++state.said;
  state.wake.notify_one();
  return true;
}

bool Outlet::flush(std::chrono::nanoseconds limit) const noexcept {
  const auto deadline = monotonic_now() + limit;
  while (!state_->is_idle() && monotonic_now() < deadline) {
    const timespec nap{.tv_sec = 0, .tv_nsec = 100'000};
    nanosleep(&nap, nullptr);
  }
  return state_->is_idle();
}

Outlet::Loss Outlet::lost() const noexcept {
  return {state_->lost, state_->reason};
}

Outlet::Loss Outlet::settle(std::chrono::nanoseconds patience) noexcept {
  State& state = *state_;
  const auto deadline = monotonic_now() + patience;
  Lock lock(state.mutex);
  for (auto time = monotonic_now(); state.waits() && time < deadline; time = monotonic_now()) {
    lock.unlock();
    flush(deadline - time);
    lock.lock();
  }
  if (state.waits()) {
    state.mode = State::Mode::Closed;
    state.lost += state.passing.all_lines() + state.waiting.all_lines();
    state.thread.detach();
  }
  return lost();
}

Outlet::Thread::Thread(Outlet& outlet) : outlet_(outlet) {
  State& state = *outlet.state_;
  const Lock lock(state.mutex);
  if (state.mode != State::Mode::Direct) return;
  state.waiting.text.reserve(kRoom);
  state.passing.text.reserve(kRoom);
  state.stopping = false;
  state.thread = own_thread([shared = outlet.state_] { shared->write_until_stopped(); });
  state.mode = State::Mode::Queued;
}

Outlet::Thread::~Thread() {
  outlet_.settle();
  State& state = *outlet_.state_;
  Lock lock(state.mutex);
  if (state.mode != State::Mode::Queued) return;
  state.mode = State::Mode::Direct;
  state.stopping = true;
  state.wake.notify_one();
  lock.unlock();
  state.thread.join();
}

Outlet& messages() {
  alignas(Outlet::State) static std::byte state[sizeof(Outlet::State)];
  alignas(Outlet) static std::byte memory[sizeof(Outlet)];
  static auto* const outlet = new (memory) Outlet(std::shared_ptr<Outlet::State>(
      std::shared_ptr<void>(), new (state) Outlet::State(STDERR_FILENO)));
  return *outlet;
}

}  // namespace lockstep::host
