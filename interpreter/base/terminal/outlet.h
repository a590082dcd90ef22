// Messages for a person, on stderr or the terminal of a replay. One place writes messages from all
// threads in order. Nothing here throws. Messages that cannot be written are counted; this is not
// an error of the caller.
//
// A command without a run writes and waits for its reader, like any program. While an
// Outlet::Thread exists, as during a run, callers do not wait: messages are queued and a thread
// writes them. If the reader does not read, lines are lost but no time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

namespace lockstep::host {

class Outlet {
 public:
  static constexpr std::size_t kRoom = 256u << 10;             // bytes that wait for the reader
  static constexpr std::chrono::milliseconds kPatience{1000};  // with the reader, at the end

  explicit Outlet(int file);
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  int file() const;
  // Prints whole lines unchanged: the caller applies printable(). May be called from any thread.
  // Lines for which there is no room are lost; a message in their place reports how many.
  void say(std::string_view lines) noexcept;
  // Prints a picture, completely or not at all: returns false while earlier output still waits for
  // the reader.
  bool show(std::string_view picture) noexcept;
  // Returns when the reader has all messages, or after this time. Async-signal-safe.
  bool flush(std::chrono::nanoseconds limit) const noexcept;

  // Lines that were lost.
  struct Loss {
    std::uint64_t lines = 0;
    int reason = 0;  // errno of the last write that failed; 0: the reader did not read
  };
  Loss lost() const noexcept;
  // The lost lines, after waiting for the reader for so long at most. Then the rest is lost, and so
  // are all later messages.
  Loss settle(std::chrono::nanoseconds patience = kPatience) noexcept;

  // Messages are written by a thread while this object exists. The destructor settles.
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
  // Shared with the thread, which may outlive this object in a write that does not return.
  std::shared_ptr<State> state_;
};

// The outlet of stderr. Needs no memory, and exists until the very end of the process.
Outlet& messages();

}  // namespace lockstep::host
