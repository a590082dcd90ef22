// One leafhost as its host sees it: a process that has loaded a plugin and answers one call at a
// time. Whatever happens to the process, a call returns and the process is reaped. Knows which
// function is called, but not the content of the messages.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/system/call_mark.h"
#include "base/system/file_descriptor.h"
#include "base/system/mutex.h"
#include "leaves/remote/child_process.h"
#include "leaves/remote/isolation_options.h"
#include "leaves/remote/shared_memory/channel.h"
#include "leaves/remote/shared_memory/message.h"

namespace lockstep::host {

class Session {
 public:
  // "", or the reason why the process could not be started.
  std::string start(const IsolationOptions& options, const std::string& plugin);
  Session() = default;
  // Kills the process if it still runs.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // The message of the next call; begin_request clears it and sets the function.
  MessageWriter& begin_request(PluginFunction function);
  MessageWriter& request() { return request_; }
  bool request_fits() const { return request_.bytes().size() <= Channel::kLargest; }
  // Returns false if there will be no answer. Then last_words() is the error of this call and
  // epitaph() that of later calls. `who` is the leaf that is called, "" for the plugin itself.
  bool call(std::string_view who);
  MessageReader answer();
  // The answer was invalid: ends the process.
  void reject_answer();

  bool is_gone() const { return given_up_ || gone_.load(); }
  // "its process was killed by SIGSEGV (Segmentation fault)", "did not return from tick for 10 s;
  // its process was killed": of the call that has just failed.
  const std::string& last_words() const { return last_words_; }
  // "its process is gone: it was killed by SIGSEGV (Segmentation fault) in tick of 'Main/arm'".
  std::string epitaph() const;

  // The last call of all, after which the process ends by itself.
  void end();

  // Sets which leaf a number in the log means. After all are forgotten, earlier lines have been
  // reported, and later lines belong to no leaf.
  void add_listener(std::uint32_t number, const lockstep_caller& caller);
  void forget_listeners();

 private:
  enum class Ending : std::uint8_t { None, Late, Nonsense };
  void watch();
  struct Log {
    void open(LogRing& ring) {
      const Lock lock(mutex);
      reader.emplace(ring);
    }
    Mutex mutex;
    std::optional<LogRingReader> reader LOCKSTEP_GUARDED_BY(mutex) = {};
  };
  bool drain(Log& log, std::size_t most = ~std::size_t{0});
  void tell(std::uint32_t number, lockstep_log_level level, const char* text);
  void fail_call(std::string_view who, Ending ending);
  std::optional<Nanoseconds> limit() const;  // of a call
  void await_end(std::optional<Nanoseconds> patience);
  std::string death() const;

  Nanoseconds hang_limit_{0};
  ChildProcess process_;
  Channel channel_;
  FileDescriptor bell_;
  std::thread watcher_;
  std::atomic<bool> gone_{false};
  mutable Mutex gone_mutex_;
  std::condition_variable gone_signal_;
  std::string death_ LOCKSTEP_GUARDED_BY(gone_mutex_);  // written by the watcher, before gone_

  PluginFunction function_ = PluginFunction::None;
  MessageWriter request_;
  bool given_up_ = false;
  std::string last_words_, blame_;

  Log call_log_;    // drained by the caller after each call
  Log thread_log_;  // by the watcher
  Mutex listeners_mutex_;
  std::vector<const lockstep_caller*> listeners_ LOCKSTEP_GUARDED_BY(listeners_mutex_);
};

}  // namespace lockstep::host
