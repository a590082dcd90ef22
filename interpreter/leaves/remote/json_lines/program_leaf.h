// A leaf whose work a program does. On the virtual clock each tick waits for the answer. On the
// wall clock an action takes the answer that is there, and until then it is running; a condition
// waits a short time, and then has its last result.
#pragma once

#include <vector>

#include "base/core/clock.h"
#include "base/core/value.h"
#include "base/json/reader.h"
#include "leaves/remote/json_lines/conversation.h"
#include "leaves/remote/json_lines/hold.h"
#include "leaves/remote/json_lines/last_result.h"
#include "leaves/remote/json_lines/listener.h"
#include "leaves/remote/json_lines/request.h"
#include "leaves/remote/remote_plugin.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class ProgramLeaf : public RemoteLeaf {
 public:
  // `listener` is that of the conversation, on the wall clock; else null.
  ProgramLeaf(const lockstep_caller& caller, Conversation& conversation, Hold hold,
              Listener* listener);

  static constexpr const char* kRunningCondition =
      "is a condition and answered 'running', expected 'success' or 'failure'";

  bool create();  // false: the caller has an error
  void start() override;
  lockstep_status tick() override;
  void halt() override;
  void pause() override;
  void resume() override;
  double progress() override;
  double set_pace(double factor) override;
  std::size_t save(void* bytes, std::size_t room) override;
  lockstep_after_cut restore(const void* bytes, std::size_t size, const lockstep_cut* cut) override;
  void end() override;
  std::string trouble() override;

 private:
  bool is_waiting() const { return listener_ == nullptr; }
  lockstep_status result();
  lockstep_status tick_and_wait();
  lockstep_status tick_without_waiting();
  lockstep_status tick_condition();
  bool keep_result(Conversation::News news);
  bool ask_and_await_answer();
  void ask_tick();
  bool send(Conversation::Asked asked);  // the request; false: it is too long, which is an error
  lockstep_status take(Conversation::News news);
  void set_ports(std::string line);
  bool await(Conversation::Asked asked);
  void stop();  // its process, by a signal
  void end_if_hanging(Nanoseconds since);
  void note_late(Nanoseconds since);
  std::string why_gone();  // "" while it is there
  bool fail_if_gone();
  bool has_error() const;
  double now() const;

  Conversation& conversation_;
  const Hold hold_;
  Listener* const listener_;
  const std::uint32_t number_;
  const bool is_condition_;
  LastResult last_;     // of a condition
  std::string reason_;  // of the last status that it has answered
  Request request_;
  std::vector<Value> sent_;
  bool is_made_ = false;   // the program was asked to create it
  bool has_begun_ = true;  // false: `start` is to be sent before the next tick
  bool is_held_ = false;
  std::optional<double> factor_;  // to be told before the next tick
  Nanoseconds told_late_{0};      // the question of which it was said; 0: none
  JsonReader reader_;
};

}  // namespace lockstep::host
