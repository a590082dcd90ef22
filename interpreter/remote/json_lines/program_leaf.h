// A leaf whose work a program does. On the virtual clock each tick waits for the answer. On the
// wall clock none does: a tick takes the answer that is there, and until then the leaf is running.
#pragma once

#include <vector>

#include "core/clock.h"
#include "core/value.h"
#include "json/reader.h"
#include "lockstep/leaf.h"
#include "remote/json_lines/conversation.h"
#include "remote/json_lines/hold.h"
#include "remote/json_lines/listener.h"
#include "remote/json_lines/request.h"
#include "remote/remote_plugin.h"

namespace lockstep::host {

class ProgramLeaf : public RemoteLeaf {
 public:
  // `listener` is that of the conversation, on the wall clock; else null.
  ProgramLeaf(const lockstep_caller& caller, Conversation& conversation, Hold hold,
              Listener* listener);

  bool create();  // false: the caller has an error
  void start() override;
  lockstep_status tick() override;
  void halt() override;
  void pause() override;
  void resume() override;
  double progress() override;
  void end() override;
  std::string trouble() override;

 private:
  bool is_waiting() const { return listener_ == nullptr; }
  lockstep_status tick_and_wait();
  lockstep_status tick_without_waiting();
  void ask_tick();
  void send(Conversation::Asked asked);  // the request
  lockstep_status take(Conversation::News news);
  void set_ports(std::string line);
  bool await(Conversation::Asked asked);
  void note_late(const Conversation::News& news);
  std::string why_gone();  // "" while it is there
  bool fail_if_gone();
  double now() const;

  Conversation& conversation_;
  const Hold hold_;
  Listener* const listener_;
  const std::uint32_t number_;
  Request request_;
  std::vector<Value> sent_;
  bool has_begun_ = true;  // false: `start` is to be sent before the next tick
  bool is_held_ = false;
  Nanoseconds told_late_{0};  // the question of which it was said; 0: none
  JsonReader reader_;
};

}  // namespace lockstep::host
