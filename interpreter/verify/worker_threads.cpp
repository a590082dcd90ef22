#include "verify/worker_threads.h"

#include <system_error>
#include <utility>

#include "base/system/own_thread.h"

namespace lockstep::host {

WorkerThreads::WorkerThreads(unsigned size)
    : failures_(size) {  // NOLINT(bugprone-throw-keyword-missing)
  try {
    for (unsigned i = 1; i < size; ++i) {
      threads_.push_back(own_thread([this, i] { serve(i); }));
    }
  } catch (const std::system_error&) {
    // With fewer of them it takes longer.
  }
}

WorkerThreads::~WorkerThreads() {
  job_ = nullptr;
  ++begun_;
  begun_.notify_all();
  for (std::thread& it : threads_) it.join();
}

void WorkerThreads::serve(unsigned number) {
  for (std::uint32_t seen = 0;; ++seen) {
    begun_.wait(seen);
    if (job_ == nullptr) return;
    do_part(number);
    if (--busy_ == 0) busy_.notify_one();
  }
}

void WorkerThreads::do_part(unsigned number) {
  try {
    (*job_)(number);
  } catch (...) {
    failures_[number] = std::current_exception();
  }
}

void WorkerThreads::work(const std::function<void(unsigned)>& job) {
  job_ = &job;
  busy_ = static_cast<std::uint32_t>(threads_.size());
  ++begun_;
  begun_.notify_all();
  do_part(0);
  for (std::uint32_t left = busy_; left != 0; left = busy_) busy_.wait(left);
  for (std::exception_ptr& it : failures_) {
    if (it != nullptr) std::rethrow_exception(std::exchange(it, nullptr));
  }
}

}  // namespace lockstep::host
