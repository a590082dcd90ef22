// The thread that reads what the programs of a run say, on the wall clock: neither reading nor a
// program that says nothing costs the tick thread any time.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "core/file_descriptor.h"
#include "plugin/program/conversation.h"

namespace lockstep {

class Listener {
 public:
  Listener();
  // Nobody listens any more.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // Which outlives it.
  void add(Conversation& conversation);
  // There is a deadline that it does not know.
  void wake();

 private:
  void listen();

  FileDescriptor bell_;
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;
  std::vector<Conversation*> conversations_;
  std::thread thread_;
};

}  // namespace lockstep
