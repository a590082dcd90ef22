#include "cli/run/prompt.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "base/system/own_thread.h"
#include "base/terminal/outlet.h"
#include "cli/console.h"
#include "judge/summary/summary.h"
#include "language/property/node_names.h"
#include "record/live/orders.h"

namespace lockstep::host {
namespace {

using When = Breakpoint::When;
using What = RunControl::Order::What;

struct WhenWord {
  std::string_view word, past;
  When when;
};
constexpr std::array<WhenWord, 5> kWhen{{{"before", "began", When::Begins},
                                         {"after", "completed", When::Completes},
                                         {"success", "succeeded", When::Succeeds},
                                         {"failure", "failed", When::Fails},
                                         {"barrier", "came to its limit", When::Barrier}}};

constexpr std::string_view kHelp =
    "  c              continue\n"
    "  s [TICKS]      tick once, or so many times (Enter repeats the last s)\n"
    "  w              why: what runs, what waits, and the reasons\n"
    "  p              print the entries\n"
    "  set KEY VALUE  write an entry\n"
    "  b NODE[:WHEN]  another breakpoint; WHEN is before, after, success, failure or barrier\n"
    "  d NODE[:WHEN]  delete it\n"
    "  q              halt the run\n";

std::string_view first_word(std::string_view& rest) {
  const auto begin = std::min(rest.find_first_not_of(' '), rest.size());
  const auto end = std::min(rest.find(' ', begin), rest.size());
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(std::min(rest.find_first_not_of(' ', end), rest.size()));
  return word;
}

bool is_in_foreground() {
  return !is_terminal(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) == getpgrp();
}

void say(const std::string& text) {
  messages().say(text);
}

}  // namespace

Result<Breakpoint> parse_breakpoint(std::string_view text, const Shape& shape) {
  const auto colon = text.rfind(':');
  const bool has_when = colon != std::string_view::npos;
  Breakpoint breakpoint;
  if (has_when) {
    const std::string_view word = text.substr(colon + 1);
    const auto found = std::ranges::find(kWhen, word, &WhenWord::word);
    if (found == kWhen.end()) {
      std::vector<std::string_view> words;
      for (const WhenWord& it : kWhen) words.push_back(it.word);
      return problem(fmt::format("'{}' is not when a node can pause the run", brief(word)),
                     suggest(word, words, "it can be"));
    }
    breakpoint.when = found->when;
  }
  const auto node = find_node(has_when ? text.substr(0, colon) : text, paths_of(shape));
  if (!node) return tl::unexpected(node.error());
  breakpoint.node = *node;
  const ShapeNode& it = shape.nodes[*node];
  if (breakpoint.when == When::Barrier && !compares_progress(it.synchronization)) {
    return problem(fmt::format("'{}' has no barriers and no delta", brief(it.path)));
  }
  return breakpoint;
}

Prompt::Prompt(const Shape& shape, RunControl& control, const PausePlaces& places,
               bool is_real_time, const OpenQuestions* questions)
    : shape_(shape),
      control_(control),
      is_real_time_(is_real_time),
      why_(shape),
      conditions_(places.conditions),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      questions_(questions) {
  for (const Breakpoint& it : places.breakpoints) set(it, true);
  thread_ = own_thread([this] { live(); });
}

Prompt::~Prompt() {
  end();
}

void Prompt::end() {
  if (!thread_.joinable()) return;
  {
    const Lock lock(mutex_);
    is_over_ = true;
  }
  eventfd_write(wake_.number(), 1);
  thread_.join();
}

void Prompt::run_ended(const Moment&, const RunEnd&) {
  end();
}

// --- in the thread of the loop -------------------------------------------------------------------

// Also when somebody else has let it go on.
void Prompt::before_tick(const Moment&, std::uint64_t, Nanoseconds) {
  if (stands_.exchange(false)) look_at_questions();
}

void Prompt::after_tick(const Moment& moment, const TickReport&) {
  why_.after_tick(moment);
  condition_ = is_closed_ ? std::string_view() : conditions_.after_tick(moment);
  if (!condition_.empty()) control_.give({.what = What::Pause});
}

void Prompt::standing(const Moment& moment) {
  Picture picture{.where = where(moment),
                  .why = {},
                  .entries = entries(moment),
                  .is_only_unattended = !control_.is_attended() && !control_.is_told_to_pause()};
  write_links(summarize(why_.why(moment), shape_), picture.why, false);
  if (is_complete(moment.status(0))) {  // there is nothing to wait for
    if (control_.reached() || !condition_.empty())
      say(fmt::format("the run ends {}\n{}", picture.where, picture.why));
    return;
  }
  if (!control_.is_paused()) return;
  {
    const Lock lock(mutex_);
    const auto& reached = control_.reached();
    picture.is_own = !condition_.empty() ||
                     (reached && std::ranges::find(breakpoints_, *reached) != breakpoints_.end());
    picture_ = std::move(picture);
  }
  stands_ = true;
  eventfd_write(wake_.number(), 1);
}

std::string Prompt::where(const Moment& moment) const {
  if (moment.number == 0) return "before the first tick";
  std::string text = fmt::format("after tick {} ({:.3f} s)", moment.tick, to_seconds(moment.time));
  if (const auto& reached = control_.reached()) {
    const auto when = std::ranges::find(kWhen, reached->when, &WhenWord::when);
    text += fmt::format(": '{}' {}", printable(shape_.nodes[reached->node].path), when->past);
  } else if (!condition_.empty()) {
    text += fmt::format(": {}", printable(condition_));
  }
  return text;
}

std::string Prompt::entries(const Moment& moment) const {
  std::string text;
  for (std::size_t i = 0; i < shape_.entries.size(); ++i) {
    const Entry& entry = moment.entries[i];
    if (!entry.has_value()) continue;
    text +=
        fmt::format("  {} = {}\n", printable(shape_.entries[i].key), brief(to_text(entry.value())));
  }
  return text.empty() ? "  no entry has a value\n" : text;
}

// --- in the thread of the person -----------------------------------------------------------------

void Prompt::live() {
  while (!is_over()) {
    auto question = next_question();
    if (!question) {
      pollfd wait{wake_.number(), POLLIN, 0};
      poll(&wait, 1, -1);
    }
    take_wake();
    std::optional<Picture> picture;
    {
      const Lock lock(mutex_);
      picture = std::exchange(picture_, std::nullopt);
    }
    if (picture) {
      ask(*picture);
    } else if (question) {
      ask(*question);
    }
  }
}

void Prompt::take_wake() const {
  eventfd_t unused = 0;
  eventfd_read(wake_.number(), &unused);
}

bool Prompt::is_over() {
  const Lock lock(mutex_);
  return is_over_;
}

void Prompt::look_at_questions() {
  eventfd_write(wake_.number(), 1);
}

// The oldest that waits for an answer.
std::optional<OpenQuestion> Prompt::next_question() const {
  if (questions_ == nullptr || is_closed_) return std::nullopt;
  for (OpenQuestion& it : questions_->now()) {
    if (it != answered_) return std::move(it);
  }
  return std::nullopt;
}

// What was typed before it was shown is no answer to it.
void Prompt::ask(const OpenQuestion& question) {
  const ShapeNode& node = shape_.nodes[question.node];
  const std::vector<std::string>& options = node.question->options;
  const bool has_numbers = std::ranges::none_of(
      options, [](const std::string& it) { return parse_int(it).has_value(); });
  std::string list;
  if (answered_ || questions_->now().size() > 1) {
    list = fmt::format("{}: {}\n", printable(node.path), printable(question.text));
  }
  for (std::size_t i = 0; i < options.size(); ++i) {
    list += has_numbers ? fmt::format("  {}  {}\n", i + 1, printable(options[i]))
                        : fmt::format("  {}\n", printable(options[i]));
  }
  if (is_terminal(STDIN_FILENO)) {
    tcflush(STDIN_FILENO, TCIFLUSH);
    rest_.clear();
  }
  say(list);
  const auto is_gone = [&] {
    if (const Lock lock(mutex_); picture_) return true;
    return next_question() != question;
  };
  while (true) {
    say(has_numbers ? fmt::format("(1 to {}) ", options.size()) : "> ");
    const auto line = read_line(is_gone);
    if (!line) {
      if (is_over() || is_gone()) return;
      close();
      return say("stdin has ended: `lockstep answer` answers from another terminal\n");
    }
    std::string_view word = *line;
    while (word.ends_with(' ') || word.ends_with('\r')) word.remove_suffix(1);
    while (word.starts_with(' ')) word.remove_prefix(1);
    const auto number = has_numbers ? parse_int(word) : std::nullopt;
    auto option = std::ranges::find(options, word);
    if (option == options.end() && number && *number >= 1 &&
        static_cast<std::size_t>(*number) <= options.size()) {
      option = options.begin() + (*number - 1);
    }
    if (option != options.end()) {
      answered_ = question;
      control_.give({.what = What::Answer,
                     .node = question.node,
                     .option = static_cast<std::uint32_t>(option - options.begin()),
                     .seen = question.tick,
                     .text = *option,
                     .who = "terminal"});
      return;
    }
    if (!word.empty()) say(fmt::format("'{}' is no answer\n", printable(word)));
  }
}

void Prompt::ask(const Picture& picture) {
  if (is_closed_) {  // who else pauses can also continue
    if (picture.is_own) give(What::Resume);
    return;
  }
  if (picture.is_only_unattended) {
    say("Enter continues the run, q ends it\n");
  } else {
    say(fmt::format("paused {}\n{}", picture.where, picture.why));
  }
  while (true) {
    if (!picture.is_only_unattended) {
      say("(c, s, w, p, set, b, d, q, or ? for help) ");
    }
    const auto line = read_line([this] { return !stands_.load(); });
    if (line) {
      control_.give({.what = What::Attend});  // who types is there
      if (picture.is_only_unattended) return *line == "q" ? give(What::Halt) : void();
      if (!obey(*line, picture)) return;
    } else if (is_over()) {
      return;
    } else if (!stands_) {
      return say("\n");
    } else {
      close();
      if (picture.is_only_unattended) return;
      say("stdin has ended: the run continues\n");
      return give(What::Resume);
    }
  }
}

std::optional<std::string> Prompt::read_line(const std::function<bool()>& is_gone) {
  constexpr std::size_t kLongest = 64 << 10;
  constexpr int kLook = 200;  // ms
  while (true) {
    if (const auto end = rest_.find('\n'); end != std::string::npos || rest_.size() > kLongest) {
      std::string line = rest_.substr(0, end);
      rest_.erase(0, end == std::string::npos ? end : end + 1);
      return line;
    }
    // A program in the background is stopped when it reads its terminal.
    const bool may_read = is_in_foreground();
    pollfd waits[] = {{may_read ? STDIN_FILENO : -1, POLLIN, 0}, {wake_.number(), POLLIN, 0}};
    poll(waits, 2, may_read ? -1 : kLook);
    if (waits[1].revents != 0) {
      take_wake();
      if (is_over() || is_gone()) return std::nullopt;
    }
    if (waits[0].revents == 0 || !is_in_foreground()) continue;
    char bytes[4096];
    const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
    if (count > 0) {
      rest_.append(bytes, static_cast<std::size_t>(count));
    } else if (rest_.empty()) {
      return std::nullopt;
    } else {
      rest_ += '\n';  // the last line may have no end
    }
  }
}

bool Prompt::obey(std::string_view line, const Picture& picture) {
  const std::string_view command = first_word(line);
  if (command == "c") return give(What::Resume), false;
  if (command == "q") return give(What::Halt), false;
  if (command == "s" || command.empty()) {
    if (!command.empty()) step_ = 1;
    if (const std::string_view count = first_word(line); !count.empty()) {
      const auto number = parse_int(count);
      if (!number || *number < 1) return say("a number of ticks: s 10\n"), true;
      step_ = static_cast<std::uint64_t>(*number);
    }
    return give(What::Step, step_), false;
  }
  if (command == "w") {
    say(picture.why);
  } else if (command == "p") {
    say(picture.entries);
  } else if (command == "set") {
    obey_set(line);
  } else if (command == "b" || command == "d") {
    obey_break(line, command == "b");
  } else {
    if (command != "?") say(fmt::format("'{}' is not a command\n", printable(command)));
    say(std::string(kHelp));
  }
  return true;
}

void Prompt::obey_set(std::string_view words) {
  const std::string_view key = first_word(words);
  const Json json = {{"do", "set"}, {"entry", key}, {"value", words}};
  auto order = read_order(shape_, is_real_time_, json.text());
  if (!order) return say(printable(order.error().message) + "\n");
  control_.give(*std::move(order));
  say(fmt::format("{} is {} from the next tick on\n", printable(key), printable(words)));
}

void Prompt::obey_break(std::string_view words, bool is_on) {
  const auto breakpoint = parse_breakpoint(first_word(words), shape_);
  if (!breakpoint) {
    const Problem& it = breakpoint.error();
    return say(printable(it.hint.empty() ? it.message : it.message + "; " + it.hint) + "\n");
  }
  set(*breakpoint, is_on);
}

void Prompt::set(const Breakpoint& breakpoint, bool is_on) {
  {
    const Lock lock(mutex_);
    std::erase(breakpoints_, breakpoint);
    if (is_on) breakpoints_.push_back(breakpoint);
  }
  control_.give({.what = What::Break, .breakpoint = breakpoint, .is_on = is_on});
}

// No command can come any more, so nothing may wait for one.
void Prompt::close() {
  is_closed_ = true;
  std::vector<Breakpoint> breakpoints;
  {
    const Lock lock(mutex_);
    breakpoints = breakpoints_;
  }
  for (const Breakpoint& it : breakpoints)
    control_.give({.what = What::Break, .breakpoint = it, .is_on = false});
}

void Prompt::give(What what, std::uint64_t ticks) {
  control_.give({.what = what, .ticks = ticks});
}

}  // namespace lockstep::host
