// Some threads that do the same work at a time, again and again. The caller is one of them.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace lockstep::host {

class WorkerThreads {
 public:
  explicit WorkerThreads(unsigned size);
  ~WorkerThreads();
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  // Calls it on each thread, with the number of the thread. Returns when all have returned, and
  // rethrows what one has thrown.
  void work(const std::function<void(unsigned)>& job);

 private:
  void serve(unsigned number);
  void do_part(unsigned number);

  const std::function<void(unsigned)>* job_ = nullptr;  // null: no other comes
  std::vector<std::exception_ptr> failures_;            // of each thread
  std::atomic<std::uint32_t> begun_{0};                 // works
  std::atomic<std::uint32_t> busy_{0};                  // threads beside the caller's
  std::vector<std::thread> threads_;
};

}  // namespace lockstep::host
