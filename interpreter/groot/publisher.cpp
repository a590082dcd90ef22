#include "groot/publisher.h"

#include <sys/eventfd.h>

#include <utility>

#include "core/own_thread.h"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kLook{100};

}  // namespace

GrootPublisher::GrootPublisher(const Tree& tree, GrootTree shown, GrootSockets sockets)
    : statuses_(tree),
      snapshots_(tree),
      answers_(tree, std::move(shown), statuses_, snapshots_),
      sockets_(std::move(sockets)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

GrootPublisher::~GrootPublisher() {
  stop();
}

void GrootPublisher::run_started(Ticker& ticker, const RunStart& start) {
  snapshots_.run_started(ticker, start);
  thread_ = own_thread([this] { serve(); });
}

void GrootPublisher::after_tick(Ticker& ticker, const TickReport& report) {
  statuses_.after_tick(ticker, report);
  snapshots_.after_tick(ticker, report);
}

void GrootPublisher::standing(Ticker& ticker) {
  snapshots_.standing(ticker);
}

void GrootPublisher::run_ended(Ticker& ticker, const RunEnd& end) {
  snapshots_.run_ended(ticker, end);
  stop();
}

void GrootPublisher::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  eventfd_write(wake_.number(), 1);
  thread_.join();
}

void GrootPublisher::serve() {
  while (!stopping_.load(std::memory_order_acquire)) serve_one(kLook);
}

bool GrootPublisher::serve_one(std::chrono::milliseconds longest) {
  const auto request = sockets_.receive(wake_.number(), longest);
  if (!request) return false;
  sockets_.reply(answers_.answer(*request));
  return true;
}

}  // namespace lockstep
