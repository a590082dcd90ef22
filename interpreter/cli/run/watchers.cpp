#include "cli/run/watchers.h"

#include <unistd.h>

#include <utility>

#include "base/terminal/outlet.h"
#include "cli/console.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

std::optional<Problem> misuse(const RunCommandOptions& options) {
  if (options.begins_paused && !options.monitor_control) {
    return Problem{"--monitor-paused needs --monitor-control",
                   "otherwise nothing can resume the run"};
  }
  if (options.monitor_control && !options.monitor && !options.monitor_socket) {
    return Problem{"--monitor-control needs --monitor or --monitor-socket"};
  }
  if (options.opens_browser && !options.monitor) {
    return Problem{"--monitor-open needs --monitor"};
  }
  if (options.monitor_linger && !options.monitor) {
    return Problem{"--monitor-linger needs --monitor"};
  }
  if (options.monitor && options.monitor_socket) {
    return Problem{"--monitor-socket is for a run without --monitor"};
  }
  if (options.groot2_control && !options.groot2) {
    return Problem{"--groot2-control needs --groot2"};
  }
  return std::nullopt;
}

// Puts what was made to its place, or gives the reason why it was not.
template <class Made, class Place>
std::optional<Problem> keep(Result<Made> made, Place& place) {
  if (!made) return std::move(made.error());
  place.emplace(std::move(*made));
  return std::nullopt;
}

// A person who has the page open may load it again; a script goes on.
Nanoseconds linger_of(const RunCommandOptions& options) {
  constexpr double kPerson = 600;
  const bool is_person = options.monitor && is_terminal(STDERR_FILENO);
  return from_seconds(options.monitor_linger.value_or(is_person ? kPerson : 0));
}

void tell_linger() {
  messages().say("monitor: serves the page until no browser has it open; Ctrl-C ends it\n");
}

}  // namespace

Result<WatcherSockets> listen_for_watchers(const RunCommandOptions& options,
                                           const Definition& definition) {
  WatcherSockets sockets;
  auto wrong = misuse(options);
  if (!wrong && options.monitor) {
    wrong = keep(listen_for_monitor(*options.monitor), sockets.monitor);
  }
  if (!wrong && options.monitor_socket) {
    wrong = keep(make_monitor_socket(*options.monitor_socket), sockets.attach);
  }
  if (!wrong && options.groot2) {
    wrong = keep(listen_for_groot(*options.groot2, definition), sockets.groot);
  }
  if (wrong) return tl::unexpected(std::move(*wrong));
  return sockets;
}

Watchers::Watchers(const Shape& shape, const RunCommandOptions& options, const RunDescription& run,
                   WatcherSockets sockets, const PausePlaces& places,
                   std::function<void(const std::string& line)> print)
    : options_(options) {
  if (options.monitor_control || options.groot2_control || !places.empty()) {
    control_.emplace();
  }
  if (!places.empty()) prompt_.emplace(shape, *control_, places, options.is_real());
  if (options.begins_paused) control_->give({.what = RunControl::Order::What::Pause});
  if (sockets.monitor || sockets.attach) {
    monitor_.emplace(
        shape, MonitorOptions{.run = run,
                              .recording = options.record,
                              .control = options.monitor_control ? control() : nullptr,
                              .linger = linger_of(options),
                              .stop = [] { return StopSignals::received() != 0; },
                              .on_linger = tell_linger,
                              .on_attached = [this](const auto& it) { link_->tell(it, false); }});
  }
  if (sockets.monitor) opened_ = monitor_->open(std::move(*sockets.monitor));
  if (sockets.attach) monitor_->open_when_asked(std::move(*sockets.attach));
  if (sockets.groot) {
    groot_ = (*sockets.groot)
                 ->show(shape, options.groot2_control ? control() : nullptr, std::move(print));
  }
}

void Watchers::tell() {
  if (monitor_) link_.emplace(options_.tree, options_.monitor_socket.value_or(""));
  if (!opened_.empty()) link_->tell(opened_, options_.opens_browser);
}

void Watchers::log(std::string_view who, std::string_view level, std::string_view text) {
  if (monitor_) monitor_->log(who, level, text);
}

void Watchers::linger() {
  if (monitor_) monitor_->linger();
}

void Watchers::add_to(std::vector<Observer*>& observers) {
  if (prompt_) observers.push_back(&*prompt_);
  if (groot_) observers.push_back(groot_.get());
  if (monitor_) observers.push_back(&*monitor_);
}

}  // namespace lockstep::host
