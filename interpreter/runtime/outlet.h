// Where lockstep speaks to a person: stderr, or the terminal of a replay. One place writes, in
// order, whatever thread speaks. Nothing here throws, and what cannot be written is counted, never
// an error of who said it.
//
// A command that halts nothing writes and waits for its reader, as any program does. While an
// Outlet::Thread lives, as during a run, nobody waits: what is said is queued, a thread writes it,
// and a reader that does not read costs lines, never time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

namespace lockstep {

class Outlet {
 public:
  static constexpr std::size_t kRoom = 256u << 10;             // bytes that wait for the reader
  static constexpr std::chrono::milliseconds kPatience{1000};  // with the reader, at the end

  explicit Outlet(int file);
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  int file() const;
  // Whole lines, shown as they are: printable() is the caller's. From any thread. Those for which
  // there is no room are lost; the reader is told how many, where they are missing.
  void say(std::string_view lines) noexcept;
  // A picture, as a whole or not at all: false while something earlier still waits for the reader.
  bool show(std::string_view picture) noexcept;
  // Returns when the reader has all that was said, or after this time. Async-signal-safe.
  bool flush(std::chrono::nanoseconds limit) const noexcept;

  // Lines that no reader has got.
  struct Loss {
    std::uint64_t lines = 0;
    int reason = 0;  // errno of the last write that failed; 0: the reader did not read
  };
  Loss lost() const noexcept;
  // What is lost by now, after the reader has had kPatience for what still waits. If that was not
  // enough, the rest is lost, and so is all that is said later.
  Loss settle() noexcept;

  // A thread writes while it lives. In the end it settles.
  class Thread {
   public:
    explicit Thread(Outlet& outlet);
    ~Thread();
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

   private:
    Outlet& outlet_;
  };

 private:
  struct State;
  explicit Outlet(std::shared_ptr<State> state) : state_(std::move(state)) {}
  friend Outlet& messages();
  // Shared with the thread, which outlives us in a write that does not return.
  std::shared_ptr<State> state_;
};

// Of stderr. Needs no memory, and stays until the very end of the process.
Outlet& messages();

}  // namespace lockstep
