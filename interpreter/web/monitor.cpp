#include "web/monitor.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <utility>

#include "core/own_thread.h"
#include "web/page.h"

namespace lockstep {
namespace {

// How long a line may wait for the thread that sends it.
constexpr std::chrono::milliseconds kNap{25};
// How long the end of a run is offered to clients that do not read it.
constexpr std::chrono::milliseconds kPatience{1000};

// What follows a place in the log, for one listener.
class Events final : public Stream {
 public:
  Events(LineLog& log, std::optional<std::uint64_t> seen)
      : log_(log), place_(log.begin(seen)), is_at_header_(!seen) {}

  Piece read(std::span<char> to) override {
    if (is_at_header_) return read_header(to);
    const auto count = log_.read(place_, to);
    if (!count) return {Piece::What::End};
    if (*count > 0) return {Piece::What::Bytes, *count};
    return {log_.is_over() ? Piece::What::End : Piece::What::Wait};
  }

 private:
  Piece read_header(std::span<char> to) {
    const std::size_t count = log_.header().copy(to.data(), to.size(), in_header_);
    in_header_ += count;
    is_at_header_ = in_header_ < log_.header().size();
    return {Piece::What::Bytes, count};
  }

  LineLog& log_;
  LineLog::Place place_;
  bool is_at_header_;
  std::size_t in_header_ = 0;
};

}  // namespace

Monitor::Monitor(const Tree& tree, MonitorOptions options, Listener listener)
    : address_(std::move(listener.address)),
      feed_(tree, std::move(options.run)),
      server_(std::move(listener.socket), *this),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

Monitor::~Monitor() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  eventfd_write(wake_.number(), 1);
  thread_.join();
}

std::string Monitor::link() const {
  return fmt::format("http://{}/", address_);
}

void Monitor::log(std::string_view who, std::string_view level, std::string_view text) {
  feed_.log(who, level, text);
}

void Monitor::run_started(Ticker& ticker, const RunStart& start) {
  feed_.run_started(ticker, start);
  log_.add_header(feed_.header());
  thread_ = own_thread([this] { serve(); });
}

void Monitor::before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  feed_.before_tick(ticker, tick, time);
}

void Monitor::after_tick(Ticker& ticker, const TickReport& report) {
  feed_.after_tick(ticker, report);
}

void Monitor::standing(Ticker& ticker) {
  feed_.standing(ticker);
  eventfd_write(wake_.number(), 1);
}

void Monitor::run_ended(Ticker& ticker, const RunEnd& end) {
  feed_.run_ended(ticker, end);
  stopping_ = true;
  eventfd_write(wake_.number(), 1);
  thread_.join();
}

void Monitor::serve() {
  while (!stopping_.load(std::memory_order_acquire)) {
    take_lines();
    server_.run();
    wait(kNap);
  }
  serve_to_the_end();
}

// The end is what everybody waits for.
void Monitor::serve_to_the_end() {
  take_lines();
  log_.add(feed_.end());
  log_.add_event("end", "{}");
  log_.close();
  server_.wake_streams();
  const Nanoseconds until = monotonic_now() + kPatience;
  for (server_.run(); server_.clients() > 0 && monotonic_now() < until; server_.run()) wait(kNap);
}

void Monitor::take_lines() {
  lines_.clear();
  feed_.take(lines_);
  for (std::string_view rest = lines_; !rest.empty();) {
    const std::size_t length = rest.find('\n') + 1;
    log_.add(rest.substr(0, length));
    rest.remove_prefix(length);
  }
  if (log_.wants_full()) feed_.want_full();
  if (!lines_.empty()) server_.wake_streams();
}

void Monitor::wait(std::chrono::milliseconds longest) {
  pollfd files[] = {{server_.descriptor(), POLLIN, 0}, {wake_.number(), POLLIN, 0}};
  poll(files, 2, static_cast<int>(longest.count()));
  eventfd_t rung = 0;
  eventfd_read(wake_.number(), &rung);
}

Answer Monitor::answer(const Request& request) {
  if (request.method != "GET") return {.status = 405, .body = "only GET\n"};
  if (request.path == "/") {
    return {.type = "text/html; charset=utf-8",
            .body =
                "<!doctype html><title>lockstep</title><p>The lines of the run are at "
                "<a href=events>events</a>.\n"};
  }
  if (request.path == "/events") {
    return {.type = "text/event-stream", .stream = std::make_unique<Events>(log_, request.after)};
  }
  return {.status = 404, .body = "there is no such page\n"};
}

}  // namespace lockstep
