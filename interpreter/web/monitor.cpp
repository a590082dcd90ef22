#include "web/monitor.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <memory>
#include <utility>

#include "core/json.h"
#include "live/orders.h"
#include "recording/write/json_lines.h"
#include "system/own_thread.h"
#include "web/history.h"
#include "web/page.h"
#include "web/token.h"

namespace lockstep {
namespace {

// How long a line may wait for the thread that sends it.
constexpr std::chrono::milliseconds kNap{25};
// How long the end of a run is offered to clients that do not read it.
constexpr std::chrono::milliseconds kPatience{500};

// How long a page that is loaded again may take to come back.
constexpr std::chrono::seconds kReload{3};

// How often a listener gets something, so that it knows that the run is there, and the server
// who has gone.
constexpr std::chrono::milliseconds kBeat{1000};

// How often those that wait look whether it is time for something.
constexpr std::chrono::milliseconds kLook{100};

// What follows a place in the log, for one listener.
class Events final : public WebStream {
 public:
  Events(LineLog& log, std::optional<std::uint64_t> seen)
      : log_(log), place_(log.begin(seen)), is_at_header_(!seen) {}

  bool is_endless() const override { return true; }

  Piece read(std::span<char> to) override {
    if (is_at_header_) return read_header(to);
    const std::size_t count = log_.read(place_, to);
    if (count > 0) return bytes(count);
    if (log_.is_over()) return {Piece::What::End};
    if (monotonic_now() - heard_ < kBeat) return {Piece::What::Wait};
    constexpr std::string_view kComment = ":\n\n";
    return bytes(kComment.copy(to.data(), to.size()));
  }

 private:
  Piece read_header(std::span<char> to) {
    const std::size_t count = log_.header().copy(to.data(), to.size(), in_header_);
    in_header_ += count;
    is_at_header_ = in_header_ < log_.header().size();
    return bytes(count);
  }

  Piece bytes(std::size_t count) {
    heard_ = monotonic_now();
    return {Piece::What::Bytes, count};
  }

  LineLog& log_;
  LineLog::Place place_;
  bool is_at_header_;
  std::size_t in_header_ = 0;
  Nanoseconds heard_{0};
};

}  // namespace

Monitor::Entrance::Entrance(ServerSocket listener, bool has_control, Answering& answering)
    : gate(std::move(listener.name),
           has_control || !listener.is_loopback ? make_token() : std::string()),
      address(std::move(listener.address)),
      server(std::move(listener.socket), answering) {}

std::string Monitor::Entrance::link() const {
  const bool has_token = !gate.token().empty();
  return fmt::format("http://{}/{}{}", address, has_token ? "#token=" : "", gate.token());
}

Monitor::Monitor(const Tree& tree, MonitorOptions options)
    : tree_(tree),
      recording_(std::move(options.recording)),
      control_(options.control),
      feed_(tree, std::move(options.run), json_lines()),
      on_attached_(std::move(options.on_attached)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      linger_(options.linger),
      stop_(std::move(options.stop)),
      on_linger_(std::move(options.on_linger)) {}

Monitor::~Monitor() {
  if (!thread_.joinable()) return;
  stopping_ = gives_up_ = true;
  eventfd_write(wake_.number(), 1);
  thread_.join();
}

std::string Monitor::open(ServerSocket listener) {
  entrance_.emplace(std::move(listener), control_ != nullptr, static_cast<Answering&>(*this));
  return entrance_->link();
}

// One that is open stays as it is.
Result<std::string> Monitor::attach(const std::string& address) {
  if (entrance_) return entrance_->link();
  auto listener = listen_on_resolved(address);
  if (!listener) return tl::unexpected(std::move(listener.error()));
  const std::string link = open(std::move(*listener));
  if (on_attached_) on_attached_(link);
  return link;
}

void Monitor::wake_streams() {
  if (entrance_) entrance_->server.wake_streams();
}

void Monitor::log(std::string_view who, std::string_view level, std::string_view text) {
  feed_.log(who, level, text);
}

void Monitor::run_started(Ticker& ticker, const RunStart& start) {
  is_real_time_ = start.real_time;
  feed_.run_started(ticker, start);
  log_.add_header(feed_.header());
  feed_.begin_taking([this] { eventfd_write(wake_.number(), 1); });
  thread_ = own_thread([this] {
    // Also when memory runs out: a tick may wait for it.
    const std::unique_ptr<LineFeed, void (*)(LineFeed*)> end(
        &feed_, [](LineFeed* feed) { feed->end_taking(); });
    serve();
  });
}

void Monitor::before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  if (control_ != nullptr && control_->pauses_after_tick()) feed_.hurry();
  feed_.before_tick(ticker, tick, time);
}

void Monitor::after_tick(Ticker& ticker, const TickReport& report) {
  feed_.after_tick(ticker, report);
}

// Whoever comes while the run is paused begins with the state in which it is, and whoever is behind
// at its end goes on with that.
void Monitor::standing(Ticker& ticker) {
  feed_.want_full();
  feed_.standing(ticker);
  eventfd_write(wake_.number(), 1);
}

void Monitor::run_ended(Ticker& ticker, const RunEnd& end) {
  feed_.run_ended(ticker, end);
  patience_ = end.budget == nullptr ? kPatience : end.budget->share(kPatience);
  stopping_ = true;
  eventfd_write(wake_.number(), 1);
  if (linger_ > Nanoseconds(0)) return;
  thread_.join();
  const bool has_readers = entrance_ && entrance_->server.streams() > 0;
  if (has_readers && end.budget != nullptr) end.budget->used_up_by("a browser of the monitor");
}

void Monitor::serve() {
  while (!stopping_.load(std::memory_order_acquire)) {
    tell_status();
    if (entrance_) entrance_->server.run();
    wait(kNap);
  }
  serve_to_the_end();
}

// The end is what everybody waits for.
void Monitor::serve_to_the_end() {
  take_lines();
  if (!feed_.end().empty()) log_.add(feed_.end());
  log_.add_event("end", "{}");
  if (entrance_) serve_those_who_linger();
  log_.close();
  if (!entrance_) return;
  HttpServer& server = entrance_->server;
  server.wake_streams();
  const Nanoseconds until = monotonic_now() + patience_;
  for (server.run(); server.streams() > 0 && monotonic_now() < until; server.run()) wait(kNap);
}

void Monitor::serve_those_who_linger() {
  HttpServer& server = entrance_->server;
  const Nanoseconds until = monotonic_now() + linger_;
  Nanoseconds seen{0};
  const auto is_awaited = [&] {
    const Nanoseconds now = monotonic_now();
    if (server.streams() > 0) seen = now;
    return seen > Nanoseconds(0) && now < seen + kReload && now < until;
  };
  for (bool is_told = false; is_awaited() && !gives_up_ && !stop_();) {
    if (is_waited_for_ && !std::exchange(is_told, true)) on_linger_();
    wake_streams();
    server.run();
    wait(kNap);
  }
}

void Monitor::linger() {
  is_waited_for_ = true;
  if (thread_.joinable()) thread_.join();
}

// A pause is reported after the line of the last tick before it, and nothing before the first line
// but a pause.
void Monitor::tell_status() {
  const auto state = control_ != nullptr ? control_->state() : RunControl::State();
  take_lines();
  const Nanoseconds now = monotonic_now();
  const bool is_early = !state.is_paused && !log_.last_full();
  const auto status = is_early ? std::nullopt : status_.next(state, feed_, is_real_time_, now);
  if (status) {
    log_.add_event("state", *status);
    wake_streams();
  }
  if (now - woken_ < kLook) return;
  woken_ = now;
  wake_streams();
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
  if (!lines_.empty()) wake_streams();
}

void Monitor::wait(std::chrono::milliseconds longest) {
  // A negative one is passed over.
  pollfd files[] = {{wake_.number(), POLLIN, 0},
                    {entrance_ ? entrance_->server.descriptor() : -1, POLLIN, 0},
                    {socket_ ? socket_->descriptor() : -1, POLLIN, 0}};
  const bool has_more = entrance_ && entrance_->server.has_more();
  poll(files, std::size(files), has_more ? 0 : static_cast<int>(longest.count()));
  eventfd_t rung = 0;
  eventfd_read(wake_.number(), &rung);
  if ((files[2].revents & POLLIN) == 0) return;
  socket_->answer([this](const std::string& address) { return attach(address); });
}

std::optional<WebAnswer> Monitor::refuse(const WebRequest& head) {
  return entrance_->gate.refuse(head);
}

WebAnswer Monitor::answer(const WebRequest& request) {
  if (request.path == "/control") {
    if (request.method == "POST") return obey(request.body);
    return {.status = 405, .body = "only POST\n"};
  }
  const bool is_known =
      request.path == "/" || request.path == "/events" || request.path == "/history";
  if (!is_known) return {.status = 404, .body = "there is no such page\n"};
  if (request.method != "GET") return {.status = 405, .body = "only GET\n"};
  if (request.path == "/") return page();
  if (request.path == "/history") {
    return {.type = "application/x-ndjson", .stream = history()};
  }
  return {.type = "text/event-stream", .stream = std::make_unique<Events>(log_, request.after)};
}

// What the recording has is followed by a line with the whole state: by a new one, if ticks come.
std::unique_ptr<WebStream> Monitor::history() {
  const bool is_paused = control_ != nullptr && control_->state().is_paused;
  const bool goes_on = !is_paused && !stopping_;
  if (goes_on) feed_.want_full();
  return std::make_unique<History>(log_, recording_, goes_on);
}

WebAnswer Monitor::page() const {
  const Json source = {{"live", true},
                       {"control", control_ != nullptr},
                       {"clock", is_real_time_ ? "wall" : "virtual"}};
  return {.type = "text/html; charset=utf-8",
          .body = page_with_source(source.text()),
          .policy = std::string(page_policy())};
}

WebAnswer Monitor::obey(const std::string& text) {
  const auto refuse = [](unsigned status, const Problem& problem) {
    Json json = {{"error", problem.message}};
    if (!problem.hint.empty()) json["hint"] = problem.hint;
    return WebAnswer{.status = status, .type = "application/json", .body = json.text() + '\n'};
  };
  if (control_ == nullptr) {
    return refuse(403, {"this monitor only shows the run", "start it with --monitor-control"});
  }
  auto order = read_order(tree_, is_real_time_, text);
  if (!order) return refuse(400, order.error());
  if (order->what == RunControl::Order::What::Break) status_.note(order->breakpoint, order->is_on);
  control_->give(std::move(*order));
  return {.status = 204};
}

}  // namespace lockstep
