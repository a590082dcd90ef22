// The thread that reads what the programs of a run say, on the wall clock, and writes to them:
// neither of it costs the tick thread any time, nor does a program that takes its processor.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "base/system/file_descriptor.h"
#include "base/system/mutex.h"
#include "leaves/remote/json_lines/conversation.h"

namespace lockstep::host {

class Listener {
 public:
  Listener();
  // Nobody listens any more.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // Which outlives it.
  void add(Conversation& conversation);
  // There is something to write, or a deadline that it does not know. One system call at most until
  // it is awake.
  void wake();
  // While there is one, a tick waits for an answer: nothing is gathered.
  class Hurry {
   public:
    explicit Hurry(Listener& listener) : hurries_(listener.hurries_) { hurries_.store(true); }
    ~Hurry() { hurries_.store(false); }
    Hurry(const Hurry&) = delete;
    Hurry& operator=(const Hurry&) = delete;

   private:
    std::atomic<bool>& hurries_;
  };

 private:
  void listen();
  std::vector<Conversation*> conversations();

  FileDescriptor bell_;
  std::atomic<bool> is_over_{false}, is_woken_{false}, hurries_{false};
  Mutex mutex_;
  std::vector<Conversation*> conversations_ LOCKSTEP_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace lockstep::host
