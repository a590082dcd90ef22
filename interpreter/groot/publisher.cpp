#include "groot/publisher.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::chrono::milliseconds kLook{100};
// A client that has not asked for so long is gone.
constexpr std::chrono::seconds kAbsent{5};
// One that has asked since then gets the end of the run, if it asks before nobody has patience.
constexpr std::chrono::seconds kPresent{1};

}  // namespace

GrootPublisher::GrootPublisher(Shape shape, GrootOptions options, GrootSockets sockets)
    : shape_(std::move(shape)),
      print_(std::move(options.print)),
      statuses_(shape_),
      snapshots_(shape_),
      answers_(shape_, std::move(options.shown), statuses_, snapshots_, options.control),
      sockets_(std::move(sockets)) {}

GrootPublisher::~GrootPublisher() {
  stop();
}

void GrootPublisher::run_started(const Moment& moment, const RunStart& start) {
  snapshots_.run_started(moment, start);
  thread_.start([this] { serve(); });
}

void GrootPublisher::after_tick(const Moment& moment, const TickReport& report) {
  statuses_.after_tick(moment, report);
  snapshots_.after_tick(moment, report);
}

void GrootPublisher::standing(const Moment& moment) {
  snapshots_.standing(moment);
}

void GrootPublisher::run_ended(const Moment& moment, const RunEnd& end) {
  snapshots_.run_ended(moment, end);
  if (end.budget != nullptr) patience_ = end.budget->share(patience_);
  stop();
  if (is_late_ && end.budget != nullptr) end.budget->used_up_by("Groot2");
}

void GrootPublisher::stop() {
  thread_.stop();
  sockets_.reset();
}

void GrootPublisher::serve() {
  while (!thread_.is_stopping()) {
    serve_one(kLook);
    watch_hooks();
  }
  serve_to_the_end();
}

// The statuses after the last tick are what a client waits for.
void GrootPublisher::serve_to_the_end() {
  thread_.forget_wakes();
  const Nanoseconds now = monotonic_now();
  if (!heard_ || now - *heard_ > kPresent) return;
  const auto left = [&] {
    return std::chrono::ceil<std::chrono::milliseconds>(now + patience_ - monotonic_now());
  };
  while (left().count() > 0) {
    if (serve_one(left()) == GrootRequest::Status) return;
  }
  is_late_ = true;
}

std::optional<GrootRequest> GrootPublisher::serve_one(std::chrono::milliseconds longest) {
  const auto request = sockets_->receive(thread_.descriptor(), longest);
  if (!request) return std::nullopt;
  heard_ = monotonic_now();
  sockets_->reply(answers_.answer(*request));
  const auto header = read_groot_header(request->front());
  return header ? std::optional(header->request) : std::nullopt;
}

// A run is not paused where nobody sees it; but one that stands does not go on because somebody has
// gone.
void GrootPublisher::watch_hooks() {
  GrootHooks& hooks = answers_.hooks();
  if (const auto node = hooks.reached()) {
    sockets_->publish(
        {to_bytes({GrootRequest::BreakpointReached, 0}), fmt::format("{}", groot_uid(*node))});
  }
  const bool is_absent = heard_ && monotonic_now() - *heard_ > kAbsent;
  if (is_absent == is_absent_) return;
  is_absent_ = is_absent;
  hooks.set_absent(is_absent);
  const auto node = is_absent ? hooks.paused_at() : std::nullopt;
  if (!node) return;
  print_(fmt::format(
      "warning: --groot2: the run is paused at '{}', and no program has connected for {} s",
      shape_.nodes[*node].path, kAbsent.count()));
}

}  // namespace lockstep::host
