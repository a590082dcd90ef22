// Tells the service manager that started this process how the run is: begun, alive, ending. The
// protocol is that of sd_notify(3), whose own function waits for a manager that does not read. Here
// nothing waits: what its socket does not take now is sent again.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <atomic>
#include <condition_variable>
#include <optional>
#include <string_view>
#include <thread>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"
#include "base/system/mutex.h"
#include "trace/observer.h"

namespace lockstep::host {

class ServiceNotice final : public Observer {
 public:
  // Why nobody can be told; nothing: it can be done, or nobody wants to know.
  static std::optional<Problem> refusal();

  // Its thread is one of lockstep's helpers, so it is made before the thread that ticks is given a
  // priority.
  ServiceNotice();
  ~ServiceNotice() override;

  void run_started(const Moment& moment, const RunStart& start) override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  bool send(std::string_view state) const;
  void watch();
  bool is_alive();
  void stop();

  FileDescriptor socket_;  // closed: nobody wants to know
  sockaddr_un address_{};
  socklen_t length_ = 0;
  Nanoseconds interval_{0};  // of the watchdog; 0: there is none

  std::atomic<std::int64_t> period_{0};  // ns; 0: the run has not begun
  std::atomic<std::uint64_t> ticks_{0};
  std::atomic<bool> stands_{false};  // paused: no tick is to come
  // These belong to the thread that tells.
  std::uint64_t seen_ = 0;
  Nanoseconds unchanged_{0};
  Mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ LOCKSTEP_GUARDED_BY(mutex_) = false;
  bool owes_ready_ LOCKSTEP_GUARDED_BY(mutex_) = false;  // the socket was full
  std::thread thread_;
};

}  // namespace lockstep::host
