// Keeps a run in a checkpoint file, after each tick. The tick thread makes bytes, and another one
// writes them: where time passes by itself, the first neither waits nor calls the system, and
// states that come faster than they are written are left out. Where time stands still, each is
// written before the next tick.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "base/core/triple_buffer.h"
#include "base/system/bell.h"
#include "engine/saved_run.h"
#include "engine/ticker.h"
#include "run/checkpoint/checkpoint_file.h"

namespace lockstep::host {

class TeamRun;

struct CheckpointOptions {
  Nanoseconds sync = std::chrono::milliseconds(100);  // at most so often
  Nanoseconds period{0};                              // of ticks
  bool real_time = true;
  const TeamRun* team = nullptr;               // must outlive this; null: the robot is in none
  const PropertyChecks* properties = nullptr;  // likewise; null: none is checked
  // Once, on the tick thread: nothing is kept any more.
  std::function<void(const std::string& error)> on_error = {};
};

class CheckpointWriter {
 public:
  // Where time passes by itself: so long after a tick its state is written at the latest, with the
  // time of the write.
  static Nanoseconds pause_of(Nanoseconds period);
  // So long after that it is synced, where nothing but time changes.
  static Nanoseconds longest_sync(Nanoseconds sync);

  CheckpointWriter(std::unique_ptr<CheckpointFile> file, CheckpointOptions options);
  // Leaves the run unfinished.
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  // Before the first tick, of a run that has `ticks` ticks behind it, and was resumed so often in a
  // row. `set`: Checkpoint::set, from which it goes on. Returns once it is synced. False: error()
  // says why.
  bool begin(Ticker& ticker, const CheckpointFacts& facts, std::uint64_t ticks,
             std::uint32_t resumes, std::span<const std::uint32_t> set = {});
  // After a tick, so many in all. `is_over`: the root has a result, or all was halted, and nothing
  // goes on from here; but the next tick may begin the tree again.
  void after_tick(Ticker& ticker, std::uint64_t ticks, bool is_over = false);
  // Between two ticks, when somebody has changed the run: the checkpoint of the last tick again,
  // with that. `waits`: until it is written, also where time passes by itself.
  void between_ticks(const Ticker& ticker, bool waits);
  // The run has ended in order, after so many ticks in all; `time` is that of the last one.
  void end(std::uint64_t ticks, Nanoseconds time);

  // "" if there is no error. What the thread has found is known after the next tick.
  std::string error() const;
  // The last tick of which a checkpoint is on the disk, by the number of RunState; all, where
  // nothing is kept any more.
  std::uint32_t durable() const { return durable_.load(std::memory_order_acquire); }
  // How many ticks were kept before it.
  std::uint64_t kept() const { return kept_.load(std::memory_order_acquire); }

 private:
  struct Snapshot {
    std::string bytes = {};
    std::uint64_t number = 0;  // from 1 on
    std::uint64_t ticks = 0;
    std::size_t lasting = 0;   // behind so many bytes: what not time alone changes
    std::uint32_t tick = 0;    // by the number of RunState
    std::uint32_t commit = 0;  // the last one in which an action waits for the disk
  };
  void note_results(const Ticker& ticker);
  void note_writes(const Ticker& ticker);
  void find_set(const Ticker& ticker);
  void take_leaves(Ticker& ticker);
  bool fill(Snapshot& snapshot, const Ticker& ticker);
  bool is_lost();
  void publish(const Ticker& ticker, bool waits);
  void lose(const std::string& why);
  void flush();
  void write_until_stopped();
  void stop();
  std::string last_bytes(Checkpoint::Kind kind, const std::string& note) const;

  const CheckpointOptions options_;
  const std::unique_ptr<CheckpointFile> file_;  // the thread's, while there is one

  Checkpoint head_;  // of the next snapshot, without the run
  LeafBytes leaves_;
  std::uint64_t number_ = 0;
  std::vector<NodeIndex> running_;     // actions, before the tick; while there were resumes
  std::vector<std::uint32_t> writes_;  // of each entry, after the last tick
  std::string lost_;                   // why nothing is kept any more, as the tick thread knows it

  TripleBuffer<Snapshot> snapshots_{Snapshot()};
  std::atomic<std::uint64_t> written_{0};  // a number
  std::atomic<std::uint64_t> kept_{0};     // ticks
  std::atomic<std::uint32_t> durable_{0};
  std::atomic<bool> failed_{false}, stopping_{false};
  Bell work_, done_;
  std::thread thread_;
};

}  // namespace lockstep::host
