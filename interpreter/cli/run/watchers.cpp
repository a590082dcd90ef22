#include "cli/run/watchers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/json/json.h"
#include "base/terminal/outlet.h"
#include "cli/console.h"
#include "cli/reach_run.h"
#include "record/live/orders.h"
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

bool needs_people(const RunCommandOptions& options, const Definition& definition) {
  const auto asks = [](const DefinitionNode& it) { return it.type->asks; };
  return options.attended || std::ranges::any_of(definition.nodes, asks);
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
  if (!wrong && !sockets.attach && needs_people(options, definition)) {
    const std::string path = Registration::own_socket();
    if (auto made = AttachSocket::at(path)) {
      sockets.attach.emplace(std::move(*made));
      sockets.own = path;
    } else {
      messages().say(
          fmt::format("lockstep: warning: `lockstep answer` and `lockstep attend` cannot "
                      "reach this run: {}\n",
                      made.error().message));
    }
  }
  if (!wrong && options.groot2) {
    wrong = keep(listen_for_groot(*options.groot2, definition), sockets.groot);
  }
  if (wrong) return tl::unexpected(std::move(*wrong));
  return sockets;
}

Watchers::Watchers(const Shape& shape, const RunCommandOptions& options, const RunDescription& run,
                   WatcherSockets sockets, const PausePlaces& places, Print print, Print note)
    : shape_(shape), options_(options), own_socket_(std::move(sockets.own)) {
  const bool needs_people = options.attended || asks_people(shape);
  if (options.monitor_control || options.groot2_control || !places.empty() || needs_people) {
    control_.emplace();
  }
  if (control_ && asks_people(shape)) tell_vain_answers(note);
  if (options.attended) {
    control_->need_attendance(from_seconds(*options.attended));
    attendance_.emplace(*control_, *options.attended, std::move(note));
  }
  if (asks_people(shape)) {
    questions_.emplace(shape, print, [this] {
      if (prompt_) prompt_->look_at_questions();
    });
  }
  if (!places.empty() || has_typist(options, shape)) {
    prompt_.emplace(shape, *control_, places, options.is_real(),
                    questions_ ? &*questions_ : nullptr);
  }
  if (options.begins_paused) control_->give({.what = RunControl::Order::What::Pause});
  if (sockets.monitor || sockets.attach) {
    monitor_.emplace(
        shape, MonitorOptions{.run = run,
                              .recording = options.record,
                              .control = options.monitor_control ? control() : nullptr,
                              .linger = linger_of(options),
                              .stop = [] { return StopSignals::received() != 0; },
                              .on_linger = tell_linger,
                              .on_request = [this](const auto& it) { return answer_request(it); },
                              .on_attached = [this](const auto& it) { link_->tell(it, false); }});
  }
  if (sockets.monitor) opened_ = monitor_->open(std::move(*sockets.monitor));
  if (sockets.attach) monitor_->open_when_asked(std::move(*sockets.attach));
  if (sockets.groot) {
    groot_ = (*sockets.groot)
                 ->show(shape, options.groot2_control ? control() : nullptr, std::move(print));
  }
}

void Watchers::tell_vain_answers(const Print& note) {
  control_->tell_vain_answers([this, note](const GivenAnswer& it, RunControl::Vain why) {
    note(fmt::format("the answer '{}' (by {}) has no effect: {} {}", printable(it.answer), it.who,
                     printable(shape_.nodes[it.node].path),
                     why == RunControl::Vain::RunEnds ? "had not taken it when the run ended"
                                                      : "waits for none"));
  });
}

bool has_typist(const RunCommandOptions& options, const Shape& shape) {
  const bool needs_people = options.attended || asks_people(shape);
  return needs_people && options.tree != "-" && is_terminal(STDIN_FILENO) &&
         is_terminal(STDERR_FILENO);
}

void Watchers::Attendance::standing(const Moment&) {
  if (control_.is_attended() || std::exchange(is_alone_, true)) return;
  note_(fmt::format("paused: unattended for {} s", longest_));
}

void Watchers::Attendance::before_tick(const Moment&, std::uint64_t, Nanoseconds) {
  if (std::exchange(is_alone_, false)) note_("continues: attended again");
}

// As many as fit into an answer, and how many more there are.
std::string Watchers::list_questions() const {
  constexpr std::size_t kMost = 60'000;  // bytes
  std::string list;
  std::size_t more = 0;
  for (const OpenQuestion& it : questions_ ? questions_->now() : std::vector<OpenQuestion>()) {
    const Json one = {{"node", it.node},
                      {"path", shape_.nodes[it.node].path},
                      {"text", it.text},
                      {"options", shape_.nodes[it.node].question->options},
                      {"tick", it.tick}};
    const std::string text = one.text();
    if (list.size() + text.size() > kMost) {
      ++more;
    } else {
      list += (list.empty() ? "" : ",") + text;
    }
  }
  return fmt::format(R"({{"questions":[{}],"more":{}}})", list, more);
}

// From another process of the same user.
Result<std::string> Watchers::answer_request(const std::string& request) {
  using What = RunControl::Order::What;
  if (request == kListQuestions) return list_questions();
  if (const auto question = answered_question(request)) {
    const auto answer =
        questions_ ? questions_->answer_to(question->node, question->tick) : std::nullopt;
    return answer ? Json({{"answer", answer->answer}, {"who", answer->who}}).text() : "{}";
  }
  auto order = read_order(shape_, options_.is_real(), request);
  if (!order) return tl::unexpected(order.error());
  if (order->what != What::Answer && order->what != What::Attend) {
    return problem("only answers and attendance come through this socket");
  }
  if (order->what == What::Attend && !options_.attended) return tl::unexpected(vain_attendance());
  const bool attends = order->what == What::Attend;
  control_->give(*std::move(order));
  return attends ? fmt::format("{}", *options_.attended) : std::string();
}

void Watchers::tell() {
  if (monitor_) link_.emplace(options_.tree, options_.monitor_socket.value_or(own_socket_));
  if (!opened_.empty()) link_->tell(opened_, options_.opens_browser);
}

void Watchers::log(std::string_view who, std::string_view level, std::string_view text) {
  if (monitor_) monitor_->log(who, level, text);
}

void Watchers::linger() {
  if (monitor_) monitor_->linger();
}

void Watchers::add_to(std::vector<Observer*>& observers) {
  if (questions_) observers.push_back(&*questions_);
  if (attendance_) observers.push_back(&*attendance_);
  if (prompt_) observers.push_back(&*prompt_);
  if (groot_) observers.push_back(groot_.get());
  if (monitor_) observers.push_back(&*monitor_);
}

}  // namespace lockstep::host
