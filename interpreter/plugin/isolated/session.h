// One leafhost as its host sees it: a process that has a plugin loaded and answers one call at a
// time. Whatever becomes of the process, a call returns, and what is left of it is reaped. Knows
// which function is called, not what the messages say.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/file_descriptor.h"
#include "plugin/call_mark.h"
#include "plugin/isolated/channel.h"
#include "plugin/isolated/child_process.h"
#include "plugin/isolated/message.h"
#include "plugin/plugin_set.h"

namespace lockstep {

class Session {
 public:
  // "" or why the process could not be started.
  std::string start(const IsolationOptions& options, const std::string& plugin);
  Session() = default;
  // Kills the process if it still lives.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // The message of the next call; begin_request clears it and says which function is meant.
  MessageWriter& begin_request(PluginFunction function);
  MessageWriter& request() { return request_; }
  bool request_fits() const { return request_.bytes().size() <= Channel::kLargest; }
  // False: there is no answer and never will be; last_words() tells the caller, epitaph() the
  // others. `who` is the leaf that is called, "" for the plugin itself.
  bool call(std::string_view who);
  MessageReader answer();
  // The answer made no sense: ends the process.
  void reject_answer();

  bool is_gone() const { return given_up_ || gone_.load(); }
  // "its process was killed by SIGSEGV (Segmentation fault)", "did not return from tick for 10 s;
  // its process was killed": of the call that has just failed.
  const std::string& last_words() const { return last_words_; }
  // "its process is gone: it was killed by SIGSEGV (Segmentation fault) in tick of 'Main/arm'".
  std::string epitaph() const;

  // The last call of all, after which the process ends by itself.
  void end();

  // Whose lines a number in the log means, until all are forgotten; then lines of before have been
  // told, and those to come are nobody's.
  void add_listener(std::uint32_t number, const lockstep_caller& caller);
  void forget_listeners();

 private:
  enum class Ending : std::uint8_t { None, Late, Nonsense };
  void watch();
  struct Log {
    std::mutex mutex;
    std::optional<LogRingReader> reader;
  };
  bool drain(Log& log, std::size_t most = ~std::size_t{0});
  void tell(std::uint32_t number, lockstep_log_level level, const char* text);
  void fail_call(std::string_view who, Ending ending);
  std::optional<Nanoseconds> limit() const;  // of a call
  void await_end(std::optional<Nanoseconds> patience);

  Nanoseconds hang_limit_{0};
  ChildProcess process_;
  Channel channel_;
  FileDescriptor bell_;
  std::thread watcher_;
  std::atomic<bool> gone_{false};
  std::mutex gone_mutex_;
  std::condition_variable gone_signal_;
  std::string death_;  // written by the watcher, before gone_

  PluginFunction function_ = PluginFunction::None;
  MessageWriter request_;
  bool given_up_ = false;
  std::string last_words_, blame_;

  Log call_log_;    // drained by the caller after each call
  Log thread_log_;  // by the watcher
  std::mutex listeners_mutex_;
  std::vector<const lockstep_caller*> listeners_;
};

}  // namespace lockstep
