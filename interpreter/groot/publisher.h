// Shows a run to Groot2 while it goes on. A thread answers it; the tick thread only passes on what
// has changed.
#pragma once

#include <atomic>
#include <thread>

#include "core/file_descriptor.h"
#include "groot/answers.h"
#include "groot/sockets.h"
#include "groot/status_feed.h"
#include "runtime/observer.h"
#include "view/snapshot_feed.h"

namespace lockstep {

class GrootPublisher final : public Observer {
 public:
  GrootPublisher(const Tree& tree, GrootTree shown, GrootSockets sockets);
  ~GrootPublisher() override;

  void run_started(Ticker& ticker, const RunStart& start) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void standing(Ticker& ticker) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

 private:
  void serve();
  bool serve_one(std::chrono::milliseconds longest);
  void stop();

  GrootStatusFeed statuses_;
  SnapshotFeed snapshots_;
  GrootAnswers answers_;
  GrootSockets sockets_;
  FileDescriptor wake_;  // an eventfd
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace lockstep
