// Shows a run to browsers while it goes on. A thread serves them; the tick thread only passes on
// what has changed (record/live/line_feed.h).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "base/core/problem.h"
#include "record/live/line_feed.h"
#include "record/live/line_log.h"
#include "record/live/run_status.h"
#include "record/live/watcher_thread.h"
#include "show/web/answer.h"
#include "show/web/attach_socket.h"
#include "show/web/gate.h"
#include "show/web/http_server.h"
#include "show/web/server_socket.h"

namespace lockstep::host {

struct MonitorOptions {
  RunDescription run;
  std::string recording = {};     // the file that the run writes; "": none
  RunControl* control = nullptr;  // what clients may order; null: they may only look
  // After the end, as long as somebody has the page open, but no longer than this, and not after
  // `stop`, which the monitor's thread asks, the page can be loaded again.
  Nanoseconds linger{0};
  std::function<bool()> stop = [] { return false; };
  // Called on that thread when somebody is waited for, after Monitor::linger.
  std::function<void()> on_linger = [] {};
  // Answers a request through the socket that is JSON, on the monitor's thread.
  std::function<Result<std::string>(const std::string& request)> on_request = {};
  // Called on the monitor's thread when it was opened through the socket.
  std::function<void(const std::string& link)> on_attached = {};
};

class Monitor final : public Observer, private Answering {
 public:
  // Nobody reaches it until it is opened.
  Monitor(Shape shape, MonitorOptions options);
  ~Monitor() override;

  // Lets clients in, before the run starts. Returns the link, for a person.
  std::string open(ServerSocket listener);
  // The same later, when somebody asks for it.
  void open_when_asked(AttachSocket socket) { socket_.emplace(std::move(socket)); }
  // After the run, when nothing else is to be done: waits until those who linger have left.
  void linger();
  // Passes on a line that a leaf has logged. May be called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  AskedOfRun asked() const override { return feed_.asked(); }
  void run_started(const Moment& moment, const RunStart& start) override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  // Where clients come in.
  struct Entrance {
    Entrance(ServerSocket listener, bool has_control, Answering& answering);
    std::string link() const;

    const Gate gate;
    const std::string address;
    HttpServer server;
  };

  Result<std::string> attach(const std::string& address);
  void wake_streams();
  void serve();
  void serve_to_the_end();
  void serve_those_who_linger();
  void take_lines();
  void tell_status();
  void wait(std::chrono::milliseconds longest);
  std::optional<WebAnswer> refuse(const WebRequest& head) override;
  WebAnswer answer(const WebRequest& request) override;
  WebAnswer page() const;
  std::unique_ptr<Stream> history();
  WebAnswer obey(const std::string& order);
  std::optional<bool> effect_of(std::uint64_t order);

  const Shape shape_;
  const std::string recording_;
  RunControl* const control_;
  bool is_real_time_ = true;
  LineFeed feed_;
  RunStatus status_;
  LineLog log_;
  std::optional<Entrance> entrance_;
  std::optional<AttachSocket> socket_;
  const std::function<Result<std::string>(const std::string& request)> on_request_;
  const std::function<void(const std::string& link)> on_attached_;
  std::string lines_;  // for its room
  Nanoseconds woken_{0};
  Nanoseconds patience_{0};  // with browsers, at the end
  const Nanoseconds linger_;
  const std::function<bool()> stop_;
  const std::function<void()> on_linger_;
  std::atomic<bool> is_waited_for_{false};
  std::atomic<bool> gives_up_{false};
  WatcherThread thread_;
};

}  // namespace lockstep::host
