// The signals that a thread blocks. Everything here is async-signal-safe.
#pragma once

#include <signal.h>

#include <initializer_list>

namespace lockstep::host {

template <class Numbers = std::initializer_list<int>>
sigset_t signal_set(const Numbers& numbers) {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : numbers) sigaddset(&set, number);
  return set;
}

inline sigset_t all_signals_but(std::initializer_list<int> numbers) {
  sigset_t set;
  sigfillset(&set);
  for (const int number : numbers) sigdelset(&set, number);
  return set;
}

inline void unblock(const sigset_t& signals) {
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

// Sets a mask for the calling thread during the life of this object. Threads that it starts
// meanwhile inherit the mask.
class SignalMask {
 public:
  // `how`: SIG_BLOCK or SIG_SETMASK.
  SignalMask(int how, const sigset_t& signals) { pthread_sigmask(how, &signals, &before_); }
  ~SignalMask() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalMask(const SignalMask&) = delete;
  SignalMask& operator=(const SignalMask&) = delete;

  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_;
};

}  // namespace lockstep::host
