// The conversation of lockstep with one program: which leaf was asked what, and what it has
// answered. Whatever the program does, nothing is kept that grows, and no answer is taken that was
// not asked for: then the program is killed, and its leaves have an error.
//
// On the virtual clock the thread of the run reads what the program says, when it waits for it. On
// the wall clock a listener does, and the thread of the run takes what is there.
#pragma once

#include <atomic>
#include <condition_variable>
#include <optional>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "base/core/running_time.h"
#include "base/json/reader.h"
#include "base/system/mutex.h"
#include "leaves/remote/isolation_options.h"
#include "leaves/remote/json_lines/program_process.h"
#include "leaves/remote/json_lines/reply.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class Conversation {
 public:
  enum class Asked : std::uint8_t { Nothing, Create, Restore, Tick, Pause, Halt };

  explicit Conversation(const IsolationOptions& options) : options_(options) {}
  // Starts the program and returns its first line.
  Result<std::string> start(const std::string& path);
  // Before it has any leaf: sends a line, and waits for the next one that is not for people.
  // `what` is asked for.
  Result<std::string> ask(std::string_view line, std::string_view what);
  // Tells it whose leaves it has: a program that says something of itself says it to the run.
  void begin(const lockstep_caller& run);

  // The number of a new leaf, from 1.
  std::uint32_t add(const lockstep_caller& leaf);
  void remove(std::uint32_t leaf);

  // Sends lines to the program, the last of which asks that. Does not wait. Where somebody else
  // reads, he also writes, when he is woken: to write to a program may mean to make way for it. A
  // leaf has not been asked anything else, except a tick before a halt, whose answer is then
  // ignored, and pauses, at any time.
  void send(std::uint32_t leaf, Asked asked, std::string_view lines);
  // Waits for the answer, at most so long; false when there is none. Not for a gone program.
  bool await(std::uint32_t leaf, Asked asked, std::optional<Nanoseconds> patience);

  // The answers of a leaf since the last call.
  struct News {
    lockstep_status status = 0;  // 0: no answer to tick
    std::string set = {};        // the line that has "set", or ""
    std::string error = {};
    std::string reason = {};                               // of the status
    lockstep_after_cut after_cut = LOCKSTEP_STARTS_AGAIN;  // of an answer to restore
    bool is_asked = false;                                 // it owes an answer
    Nanoseconds since{0};                                  // when it was asked, of now()
    Nanoseconds answered{0};  // when the answer to tick came, on the clock of the machine
  };
  News take(std::uint32_t leaf);
  // Takes only the error of the news; the rest stays for the next tick.
  News take_error(std::uint32_t leaf);
  double progress(std::uint32_t leaf);
  // The pace below which it does not go, as it has said; else 0.
  double least_pace(std::uint32_t leaf);
  // What it keeps for a checkpoint, as it was last sent.
  std::string kept(std::uint32_t leaf);
  void keep(std::uint32_t leaf, std::string_view text);
  // A new activation: what it has said before does not count.
  void forget(std::uint32_t leaf);
  // The time in which the leaf was held does not count as its own.
  void forgive(std::uint32_t leaf);

  // For limits: the time in which lockstep itself was stopped does not pass.
  Nanoseconds now();

  // Once true, the program has ended or is about to. `why` continues "its program ".
  bool is_gone() const { return gone_.load(); }
  std::string why_gone();
  // Kills it, unless it is gone already.
  void give_up(std::string why);

  // For the thread that reads. Takes what the program has said. False: it says no more.
  bool listen();
  // The same. Writes what was sent.
  void flush();
  // The descriptor from which its answers are read; -1: there will be no more.
  int output() const { return has_said_all_ ? -1 : process_.output(); }
  // It has closed its output or input, and not ended in the time for that.
  bool is_overdue() { return dies_until_ && now() >= *dies_until_; }
  // When the listener is to look at it again, whatever it says, and what it does then.
  std::optional<Nanoseconds> deadline();
  void check_deadline();

  // Waits for the end of the process of a program that is gone, when nobody else does.
  void bury();

  ProgramProcess& process() { return process_; }
  // The end, when no listener reads any more. Closes its input, at which it is to end.
  void begin_end();
  // Reads what it says until it has ended, or until then on this clock; nothing: without end.
  // False: it has not.
  bool await_end(RunningClock& clock, std::optional<Nanoseconds> until);
  // Ends it otherwise, if it has not: does not wait.
  void hurry_end();
  // Waits for that. "", or what it took.
  std::string end();
  // Somebody else reads.
  void set_listened(bool is_listened) { is_listened_ = is_listened; }
  const IsolationOptions& options() const { return options_; }
  std::optional<Nanoseconds> hang_limit() const;

 private:
  struct Leaf {
    const lockstep_caller* caller = nullptr;  // null: removed
    bool is_condition = false;                // an answer is news, also after a halt
    Asked asked = Asked::Nothing;  // the last but pauses; a tick before a halt is `owes_tick`
    bool owes_tick = false;
    std::uint32_t pauses = 0;  // that it owes an answer
    Nanoseconds since{0};
    bool has_erred = false;  // for the tick it may still have an answer
    News news = {};
    double progress = 0;
    double least_pace = 0;
    std::string kept = {};

    bool owes(Asked what) const { return what == Asked::Pause ? pauses > 0 : asked == what; }
    bool owes_anything() const { return asked != Asked::Nothing || pauses > 0; }
    Asked owed_first() const;
  };
  Result<std::string> next_line(std::string_view what);
  bool owes(std::uint32_t leaf, Asked asked);
  bool await_here(std::uint32_t leaf, Asked asked, std::optional<Nanoseconds> patience);
  bool find_unasked();
  bool is_output_over();
  void read_more(std::optional<Nanoseconds> patience);
  void take_line();
  std::string take_reply();
  void take_error(Leaf& leaf) LOCKSTEP_REQUIRES(mutex_);
  std::string take_answer(Leaf& leaf) LOCKSTEP_REQUIRES(mutex_);
  void note_end();
  void judge(ProgramProcess::Written written);
  void note_deaf();
  std::optional<std::string> await_death();
  void end_late(std::string_view leaf);
  bool ends_softly();
  bool is_late(const Leaf& leaf, Nanoseconds now) const;
  std::optional<Nanoseconds> end_of(std::optional<Nanoseconds> patience);
  std::optional<Nanoseconds> wait_until(std::optional<Nanoseconds> until);
  std::string blamed();

  const IsolationOptions& options_;
  ProgramProcess process_;
  std::string by_hand_;  // the command that starts it without lockstep
  bool is_listened_ = false;
  JsonReader reader_;  // these: of the thread that reads
  std::string line_;
  Reply reply_;
  std::string written_;  // keeps its capacity
  bool has_said_all_ = false, is_deaf_ = false;
  std::optional<Nanoseconds> dies_until_;

  bool was_gone_ = false, is_hurried_ = false;  // these: at the end
  Nanoseconds closed_{0};                       // when its input was

  Mutex mutex_;
  RunningClock clock_ LOCKSTEP_GUARDED_BY(mutex_);
  std::condition_variable answered_;
  std::vector<Leaf> leaves_ LOCKSTEP_GUARDED_BY(mutex_);
  const lockstep_caller* run_ LOCKSTEP_GUARDED_BY(mutex_) = nullptr;
  std::string outgoing_ LOCKSTEP_GUARDED_BY(mutex_);
  std::string why_gone_ LOCKSTEP_GUARDED_BY(mutex_);
  bool ends_softly_ LOCKSTEP_GUARDED_BY(mutex_) = false;
  std::atomic<bool> gone_{false};
};

// "tick", "halt".
const char* name_of(Conversation::Asked asked);

}  // namespace lockstep::host
