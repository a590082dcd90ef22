// Shows a run to Groot2 while it goes on. A thread answers it; the tick thread only passes on what
// has changed.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/core/clock.h"
#include "groot/answers.h"
#include "groot/sockets.h"
#include "record/live/snapshot_feed.h"
#include "record/live/status_feed.h"
#include "record/live/watcher_thread.h"
#include "trace/observer.h"

namespace lockstep::host {

struct GrootOptions {
  GrootTree shown;
  RunControl* control = nullptr;  // null: clients may only look
  // Shows a line to the person; from another thread.
  std::function<void(const std::string& line)> print;
};

class GrootPublisher final : public Observer {
 public:
  GrootPublisher(Shape shape, GrootOptions options, GrootSockets sockets);
  ~GrootPublisher() override;

  AskedOfRun asked() const override { return statuses_.asked(); }
  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  void serve();
  void serve_to_the_end();
  std::optional<GrootRequest> serve_one(std::chrono::milliseconds longest);
  void watch_hooks();
  void stop();

  const Shape shape_;
  const std::function<void(const std::string& line)> print_;
  StatusFeed statuses_;
  SnapshotFeed snapshots_;
  GrootAnswers answers_;
  std::optional<GrootSockets> sockets_;
  std::optional<Nanoseconds> heard_;                       // the last request came at this time
  bool is_absent_ = false;                                 // nobody has asked for long
  Nanoseconds patience_ = std::chrono::milliseconds(500);  // with the last request, at the end
  bool is_late_ = false;                                   // it did not come
  WatcherThread thread_;
};

}  // namespace lockstep::host
