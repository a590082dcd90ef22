// A mutex whose rules clang checks (-Wthread-safety, in ./dev tidy): what is marked with
// LOCKSTEP_GUARDED_BY(mutex_) is read and written under its lock only, and a function that is
// marked with LOCKSTEP_REQUIRES(mutex_) is called under it. For other compilers it is a std::mutex.
#pragma once

#include <condition_variable>
#include <mutex>

#include "base/core/clock.h"

#if defined(__clang__)
#define LOCKSTEP_THREAD_SAFETY(attribute) __attribute__((attribute))
#else
#define LOCKSTEP_THREAD_SAFETY(attribute)
#endif
#define LOCKSTEP_GUARDED_BY(mutex) LOCKSTEP_THREAD_SAFETY(guarded_by(mutex))
#define LOCKSTEP_REQUIRES(mutex) LOCKSTEP_THREAD_SAFETY(requires_capability(mutex))

namespace lockstep::host {

class LOCKSTEP_THREAD_SAFETY(capability("mutex")) Mutex {
 private:
  friend class Lock;
  std::mutex it_;
};

// Holds a mutex for the time of its scope, but between unlock and lock.
class LOCKSTEP_THREAD_SAFETY(scoped_lockable) Lock {
 public:
  explicit Lock(Mutex& mutex) LOCKSTEP_THREAD_SAFETY(acquire_capability(mutex)) : it_(mutex.it_) {}
  ~Lock() LOCKSTEP_THREAD_SAFETY(release_capability()) = default;
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  void unlock() LOCKSTEP_THREAD_SAFETY(release_capability()) { it_.unlock(); }
  void lock() LOCKSTEP_THREAD_SAFETY(acquire_capability()) { it_.lock(); }

  // May return early. A loop around it looks at what it waits for, which a lambda could not do: the
  // check does not know that it runs under the lock.
  void wait(std::condition_variable& changed) { changed.wait(it_); }
  void wait_for(std::condition_variable& changed, Nanoseconds time) { changed.wait_for(it_, time); }

 private:
  std::unique_lock<std::mutex> it_;
};

}  // namespace lockstep::host
