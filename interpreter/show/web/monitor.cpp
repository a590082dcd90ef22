#include "show/web/monitor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "record/live/history.h"
#include "record/live/orders.h"
#include "show/web/page.h"
#include "show/web/server_sent.h"
#include "show/web/token.h"

namespace lockstep::host {
namespace {

// How long a line may wait for the thread that sends it.
constexpr std::chrono::milliseconds kNap{25};
// How long the end of a run is offered to clients that do not read it.
constexpr std::chrono::milliseconds kPatience{500};

// How long a page that is loaded again may take to come back.
constexpr std::chrono::seconds kReload{3};

// How long a request waits for the run to obey its order.
constexpr std::chrono::milliseconds kObeyed{500};

// How often those that wait look whether it is time for something.
constexpr std::chrono::milliseconds kLook{100};

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

Monitor::Monitor(Shape shape, MonitorOptions options)
    : shape_(std::move(shape)),
      recording_(std::move(options.recording)),
      control_(options.control),
      feed_(shape_, std::move(options.run)),
      on_request_(std::move(options.on_request)),
      on_attached_(std::move(options.on_attached)),
      linger_(options.linger),
      stop_(std::move(options.stop)),
      on_linger_(std::move(options.on_linger)) {}

Monitor::~Monitor() {
  gives_up_ = true;
  thread_.stop();
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

void Monitor::run_started(const Moment& moment, const RunStart& start) {
  is_real_time_ = start.real_time;
  feed_.run_started(moment, start);
  log_.set_header(sent_line(feed_.header()));
  feed_.begin_taking([this] { thread_.wake(); });
  thread_.start([this] {
    // Also when memory runs out: a tick may wait for it.
    const std::unique_ptr<LineFeed, void (*)(LineFeed*)> end(
        &feed_, [](LineFeed* feed) { feed->end_taking(); });
    serve();
  });
}

void Monitor::before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) {
  if (control_ != nullptr && control_->pauses_after_tick()) feed_.hurry();
  feed_.before_tick(moment, tick, time);
}

void Monitor::after_tick(const Moment& moment, const TickReport& report) {
  feed_.after_tick(moment, report);
}

// Whoever comes while the run is paused begins with the state in which it is, and whoever is behind
// at its end goes on with that.
void Monitor::standing(const Moment& moment) {
  feed_.want_full();
  feed_.standing(moment);
  thread_.wake();
}

void Monitor::run_ended(const Moment& moment, const RunEnd& end) {
  feed_.run_ended(moment, end);
  patience_ = end.budget == nullptr ? kPatience : end.budget->share(kPatience);
  thread_.ask_to_stop();
  if (linger_ > Nanoseconds(0)) return;
  thread_.join();
  const bool has_readers = entrance_ && entrance_->server.streams() > 0;
  if (has_readers && end.budget != nullptr) end.budget->used_up_by("a browser of the monitor");
}

void Monitor::serve() {
  while (!thread_.is_stopping()) {
    tell_status();
    if (entrance_) entrance_->server.run();
    wait(kNap);
  }
  serve_to_the_end();
}

// The end is what everybody waits for.
void Monitor::serve_to_the_end() {
  take_lines();
  if (!feed_.end().empty()) log_.add(sent_line(feed_.end()));
  log_.add(sent_event("end", "{}"));
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
  if (thread_.is_started()) thread_.join();
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
    log_.add_state(sent_event("state", *status));
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
    log_.add(sent_line(rest.substr(0, length)));
    rest.remove_prefix(length);
  }
  if (log_.wants_full()) feed_.want_full();
  if (!lines_.empty()) wake_streams();
}

void Monitor::wait(std::chrono::milliseconds longest) {
  // A negative one is passed over.
  pollfd files[] = {{thread_.descriptor(), POLLIN, 0},
                    {entrance_ ? entrance_->server.descriptor() : -1, POLLIN, 0},
                    {socket_ ? socket_->descriptor() : -1, POLLIN, 0}};
  const bool has_more = entrance_ && entrance_->server.has_more();
  poll(files, std::size(files), has_more ? 0 : static_cast<int>(longest.count()));
  thread_.forget_wakes();
  if ((files[2].revents & POLLIN) == 0) return;
  socket_->answer([this](const std::string& request) {
    const bool is_json = request.starts_with('{') && on_request_;
    return is_json ? on_request_(request) : attach(request);
  });
}

std::optional<WebAnswer> Monitor::refuse(const WebRequest& head) {
  return entrance_->gate.refuse(head);
}

WebAnswer Monitor::answer(const WebRequest& request) {
  if (request.path == "/control") {
    if (request.method == "POST") return obey(request.body);
    return refusal(405, {"only POST"});
  }
  const bool is_known =
      request.path == "/" || request.path == "/events" || request.path == "/history";
  if (!is_known) return refusal(404, {"there is no such page"});
  if (request.method != "GET") return refusal(405, {"only GET"});
  if (request.path == "/") return page();
  if (request.path == "/history") {
    return {.type = "application/x-ndjson", .stream = history()};
  }
  return {.type = "text/event-stream", .stream = std::make_unique<ServerSent>(log_, request.after)};
}

// The lines of the recording are followed by a line with the whole state: by a new one, if ticks
// come.
std::unique_ptr<Stream> Monitor::history() {
  const bool is_paused = control_ != nullptr && control_->state().is_paused;
  const bool goes_on = !is_paused && !thread_.is_stopping();
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
  using What = RunControl::Order::What;
  if (control_ == nullptr) {
    return refusal(403, {"this monitor only shows the run", "start it with --monitor-control"});
  }
  auto order = read_order(shape_, is_real_time_, text);
  if (!order) return refusal(400, order.error());
  order->who = order->who.empty() ? "page" : "page: " + order->who;
  if (order->what == What::Break) status_.note(order->breakpoint, order->is_on);
  if (order->what == What::Attend && !control_->state().is_attended)
    return refusal(409, vain_attendance());
  const NodeIndex node = order->node;
  // The others say themselves what comes of them, or nothing can come between.
  const bool changes_state = order->what == What::Set || order->what == What::Answer;
  if (control_->has_ended()) return refusal(409, {"the run has ended"});
  const std::uint64_t number = control_->give(std::move(*order));
  if (!changes_state) return {.status = 204};
  const auto effect = effect_of(number);
  if (effect.value_or(true)) return {.status = effect ? 204u : 202u};
  if (control_->has_ended()) return refusal(409, {"the run has ended"});
  return refusal(409,
                 {fmt::format("'{}' waits for no such answer", printable(shape_.nodes[node].path)),
                  "its question is over, has an answer already, or is newer than 'seen'"});
}

// None: the run has not obeyed it in time, as in a long tick. Where time stands still, the run may
// wait for this thread to take its lines.
std::optional<bool> Monitor::effect_of(std::uint64_t order) {
  const Nanoseconds until = monotonic_now() + kObeyed;
  while (true) {
    const auto effect = control_->effect_of(order);
    const Nanoseconds left = until - monotonic_now();
    if (effect || left <= Nanoseconds(0)) return effect;
    take_lines();
    control_->wait_for_effects(std::min<Nanoseconds>(left, kNap));
  }
}

}  // namespace lockstep::host
