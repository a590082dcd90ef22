#include "leaves/remote/json_lines/conversation.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/core/shell_word.h"
#include "base/core/wording.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/remote/json_lines/guardian.h"

namespace lockstep::host {
namespace {

// After the end of its output, or of its input.
constexpr Nanoseconds kToDie = std::chrono::seconds(1);
constexpr const char* kGoodEnd = "ended with exit code 0";
constexpr Nanoseconds kToFlush = std::chrono::milliseconds(1);

std::string shown(std::string_view line) {
  return fmt::format("'{}'", brief(printable(line)));
}

std::string command_by_hand(const std::string& path, const std::string& leafhost) {
  const std::string command = shell_word(path.find('/') == std::string::npos ? "./" + path : path);
  if (!path.ends_with(".py")) return command;
  const std::filesystem::path directory = std::filesystem::path(leafhost).parent_path();
  return fmt::format("PYTHONPATH={} {}", shell_word(python_modules(directory).string()), command);
}

}  // namespace

const char* name_of(Conversation::Asked asked) {
  constexpr const char* kNames[] = {"nothing", "create", "restore", "tick", "pause", "halt"};
  return kNames[static_cast<std::size_t>(asked)];
}

std::optional<Nanoseconds> Conversation::hang_limit() const {
  return options_.hang_limit == Nanoseconds(0) ? std::nullopt : std::optional(options_.hang_limit);
}

Result<std::string> Conversation::start(const std::string& path) {
  by_hand_ = command_by_hand(path, options_.leafhost);
  if (auto failure = process_.start(options_.leafhost, path); !failure.empty()) {
    return problem(fmt::format("does not start: {}", failure),
                   "a program is executable, and a script begins with #! and its interpreter");
  }
  return next_line("listed its leaves");
}

Result<std::string> Conversation::ask(std::string_view line, std::string_view what) {
  if (is_gone()) return problem(why_gone());
  process_.write(line);  // a deaf one says nothing, either
  auto answer = next_line(fmt::format("answered {}", what));
  while (answer) {
    if (!read_reply(reader_, *answer, reply_).empty() || reply_.what != Reply::What::Log) break;
    answer = next_line(fmt::format("answered {}", what));
  }
  return answer;
}

// A line, or the problem that it has before it has done `what`.
Result<std::string> Conversation::next_line(std::string_view what) {
  const auto until = end_of(hang_limit());
  const bool is_first = what == "listed its leaves";
  const char* const hint = is_first ? "its first line lists its leaves; is its output buffered?"
                                    : "is its output buffered?";
  while (!process_.lines.next(line_)) {
    const auto left = wait_until(until);
    const bool is_late = left == Nanoseconds(0);
    if (is_late || process_.lines.is_too_long()) {
      return problem(is_late
                         ? fmt::format("prints nothing for {:g} s", to_seconds(options_.hang_limit))
                         : "prints more than a line of 1 MiB",
                     hint);
    }
    if (!process_.await_output(left)) continue;
    if (process_.has_unwritten()) process_.write({});
    if (is_output_over()) {
      const auto death = process_.await_end(kToDie);
      return problem(death ? fmt::format("{} before it {}", *death, what)
                           : fmt::format("closed its output before it {}", what),
                     "run it by hand to see what it prints: " + by_hand_);
    }
  }
  return line_;
}

// Takes what there is. What it has started may hold its output open when it has ended.
bool Conversation::is_output_over() {
  const bool has_ended = process_.has_ended();
  const auto filled = process_.lines.fill(process_.output());
  return filled == LineInput::Filled::End || (filled == LineInput::Filled::Nothing && has_ended);
}

void Conversation::begin(const lockstep_caller& run) {
  const Lock lock(mutex_);
  run_ = &run;
}

std::uint32_t Conversation::add(const lockstep_caller& leaf) {
  const Lock lock(mutex_);
  leaves_.push_back({.caller = &leaf, .is_condition = leaf.type->leaf->kind == LOCKSTEP_CONDITION});
  return static_cast<std::uint32_t>(leaves_.size());
}

void Conversation::remove(std::uint32_t leaf) {
  const Lock lock(mutex_);
  leaves_[leaf - 1].caller = nullptr;
}

void Conversation::send(std::uint32_t number, Asked asked, std::string_view lines) {
  if (is_gone() || (asked == Asked::Tick && !is_listened_ && find_unasked())) return;
  {
    const Lock lock(mutex_);
    Leaf& leaf = leaves_[number - 1];
    if (asked == Asked::Pause) {
      if (!leaf.owes_anything()) leaf.since = clock_.now();
      ++leaf.pauses;
    } else if (asked != Asked::Nothing) {
      leaf.owes_tick = leaf.asked == Asked::Tick;
      leaf.asked = asked;
      leaf.since = clock_.now();
      if (asked == Asked::Tick) {
        leaf.news.status = 0;
        leaf.has_erred = false;
      }
    }
    outgoing_ += lines;
  }
  if (!is_listened_) flush();
}

void Conversation::judge(ProgramProcess::Written written) {
  if (written == ProgramProcess::Written::Deaf) return note_deaf();
  if (written == ProgramProcess::Written::TooMuch) {
    give_up("did not read what it was sent; it was killed" + blamed());
  }
}

// A program that does not read any more has mostly ended. Its last words and its end are still to
// be read by the one that waits for an answer: so what is said of it does not depend on who was
// faster.
void Conversation::note_deaf() {
  is_deaf_ = true;
  if (await_death() || !is_overdue()) return;
  give_up("closed its input; it was killed" + blamed());
}

// Its guardian tells of its end a moment after that of its output or input. Others wait for the
// thread that listens, which therefore comes back for it.
std::optional<std::string> Conversation::await_death() {
  if (!dies_until_) dies_until_ = now() + kToDie;
  while (true) {
    const auto left = is_listened_ ? Nanoseconds(0) : wait_until(dies_until_);
    auto death = process_.await_end(left);
    if (death || left == Nanoseconds(0)) return death;
  }
}

// Only what takes no time is done under the lock, for which the tick thread would wait.
void Conversation::flush() {
  {
    const Lock lock(mutex_);
    outgoing_.swap(written_);
  }
  const bool has_more = !written_.empty() || process_.has_unwritten();
  if (has_more && !is_gone()) judge(process_.write(written_));
  written_.clear();
}

bool Conversation::await(std::uint32_t number, Asked asked, std::optional<Nanoseconds> patience) {
  if (!is_listened_) return await_here(number, asked, patience);
  const auto until = end_of(patience);
  Lock lock(mutex_);
  while (!is_gone() && leaves_[number - 1].owes(asked)) {
    const auto left = clock_.wait_until(until);
    if (!left) {
      lock.wait(answered_);
    } else if (*left > Nanoseconds(0)) {
      lock.wait_for(answered_, *left);
    } else {
      return false;
    }
  }
  return !is_gone();
}

Nanoseconds Conversation::now() {
  const Lock lock(mutex_);
  return clock_.now();
}

std::optional<Nanoseconds> Conversation::end_of(std::optional<Nanoseconds> patience) {
  return patience ? std::optional(now() + *patience) : std::nullopt;
}

std::optional<Nanoseconds> Conversation::wait_until(std::optional<Nanoseconds> until) {
  const Lock lock(mutex_);
  return clock_.wait_until(until);
}

bool Conversation::owes(std::uint32_t leaf, Asked asked) {
  const Lock lock(mutex_);
  return leaves_[leaf - 1].owes(asked);
}

// Nothing that comes after the answer is taken: when it comes is not the same in every run.
bool Conversation::await_here(std::uint32_t leaf, Asked asked,
                              std::optional<Nanoseconds> patience) {
  const auto until = end_of(patience);
  while (!is_gone() && owes(leaf, asked)) {
    if (process_.lines.next(line_)) {
      take_line();
      continue;
    }
    const auto left = wait_until(until);
    if (left == Nanoseconds(0)) return false;
    read_more(left);
  }
  return !is_gone();
}

// Where each answer is waited for, one that is there before the question would be taken for the
// answer to it. Everything else that is there stays for its time.
bool Conversation::find_unasked() {
  process_.lines.fill(process_.output());
  std::size_t place = 0;
  while (process_.lines.look(place, line_)) {
    if (!read_reply(reader_, line_, reply_).empty()) return false;  // its time comes
    const bool is_answer = reply_.what == Reply::What::Status || reply_.what == Reply::What::Done;
    std::string why;
    {
      const Lock lock(mutex_);
      if (!is_answer || reply_.leaf == 0 || reply_.leaf > leaves_.size()) continue;
      if (leaves_[reply_.leaf - 1].has_erred) continue;
      why = take_answer(leaves_[reply_.leaf - 1]);
    }
    give_up(std::move(why));
    return true;
  }
  return false;
}

void Conversation::read_more(std::optional<Nanoseconds> patience) {
  if (process_.lines.is_too_long()) {
    return give_up("was killed, since it wrote a line of more than 1 MiB" + blamed());
  }
  if (!process_.await_output(patience)) return;
  // What it cannot answer before it has read it to the end.
  if (process_.has_unwritten()) judge(process_.write({}));
  if (!is_gone() && is_output_over()) note_end();
}

Conversation::News Conversation::take(std::uint32_t number) {
  const Lock lock(mutex_);
  Leaf& leaf = leaves_[number - 1];
  News news = std::exchange(leaf.news, {});
  news.is_asked = leaf.owes_anything();
  news.since = leaf.since;
  return news;
}

Conversation::News Conversation::take_error(std::uint32_t number) {
  const Lock lock(mutex_);
  Leaf& leaf = leaves_[number - 1];
  return {.error = std::exchange(leaf.news.error, {}),
          .is_asked = leaf.owes_anything(),
          .since = leaf.since};
}

double Conversation::progress(std::uint32_t leaf) {
  const Lock lock(mutex_);
  return leaves_[leaf - 1].progress;
}

double Conversation::least_pace(std::uint32_t leaf) {
  const Lock lock(mutex_);
  return leaves_[leaf - 1].least_pace;
}

std::string Conversation::kept(std::uint32_t leaf) {
  const Lock lock(mutex_);
  return leaves_[leaf - 1].kept;
}

void Conversation::keep(std::uint32_t leaf, std::string_view text) {
  const Lock lock(mutex_);
  leaves_[leaf - 1].kept = text;
}

void Conversation::forget(std::uint32_t number) {
  const Lock lock(mutex_);
  Leaf& leaf = leaves_[number - 1];
  leaf.progress = 0;
  leaf.kept.clear();
  leaf.news.status = 0;
  leaf.news.set.clear();
}

void Conversation::forgive(std::uint32_t leaf) {
  const Lock lock(mutex_);
  leaves_[leaf - 1].since = clock_.now();
}

std::string Conversation::why_gone() {
  const Lock lock(mutex_);
  return why_gone_;
}

void Conversation::give_up(std::string why) {
  {
    const Lock lock(mutex_);
    if (is_gone()) return;
    why_gone_ = std::move(why);
    gone_.store(true);
  }
  process_.kill();
  answered_.notify_all();
  if (!is_listened_) bury();
}

bool Conversation::ends_softly() {
  const Lock lock(mutex_);
  return ends_softly_;
}

// One that is asked to end has time for that.
void Conversation::bury() {
  if (!ends_softly()) process_.bury();
}

bool Conversation::listen() {
  read_more(Nanoseconds(0));
  while (!is_gone() && process_.lines.next(line_)) take_line();
  if (!is_gone() && is_deaf_) note_deaf();
  return !is_gone();
}

std::optional<Nanoseconds> Conversation::deadline() {
  std::optional<Nanoseconds> first;
  const auto add = [&, now = monotonic_now()](Nanoseconds wait) {
    first = std::min(first.value_or(now + wait), now + wait);
  };
  const Lock lock(mutex_);
  if (process_.has_unwritten()) add(kToFlush);
  if (dies_until_) add(*clock_.wait_until(dies_until_));
  for (const Leaf& leaf : leaves_) {
    if (!leaf.owes_anything() || leaf.caller == nullptr) continue;
    const bool is_limited = leaf.asked == Asked::Halt && options_.halt_limit;
    add(is_limited ? *clock_.wait_until(leaf.since + *options_.halt_limit)
                   : RunningClock::kInterval);  // the thread that ticks looks at it
  }
  return first;
}

bool Conversation::is_late(const Leaf& leaf, Nanoseconds now) const {
  return options_.halt_limit && leaf.asked == Asked::Halt && leaf.caller != nullptr &&
         now >= leaf.since + *options_.halt_limit;
}

void Conversation::check_deadline() {
  std::string late;
  {
    const Lock lock(mutex_);
    const Nanoseconds now = clock_.now();
    for (const Leaf& leaf : leaves_) {
      if (late.empty() && is_late(leaf, now)) late = leaf.caller->who;
    }
  }
  if (!late.empty()) end_late(late);
}

// The program may do what it likes when it is asked to end.
void Conversation::end_late(std::string_view leaf) {
  {
    const Lock lock(mutex_);
    if (is_gone()) return;
    why_gone_ = fmt::format("did not answer halt of '{}' for {:g} s; it was ended", leaf,
                            to_seconds(*options_.halt_limit));
    ends_softly_ = true;
    gone_.store(true);
    if (run_ != nullptr) {
      host_table().log(run_, LOCKSTEP_LOG_WARNING, ("its program " + why_gone_).c_str());
    }
  }
  process_.end_softly(options_.halt_limit);
  answered_.notify_all();
}

// The end of its output, which is mostly its own.
void Conversation::note_end() {
  has_said_all_ = true;
  const bool has_rest = process_.lines.has_rest();
  const auto death = await_death();
  if (!death && !is_overdue()) return;
  give_up(fmt::format("{}{}{}", death ? *death : "closed its output; it was killed",
                      has_rest ? " in the middle of a line" : "", blamed()));
}

// The leaf that is to blame for what the program does: the one that it is to answer.
std::string Conversation::blamed() {
  const Lock lock(mutex_);
  for (const Leaf& leaf : leaves_) {
    if (!leaf.owes_anything() || leaf.caller == nullptr) continue;
    return fmt::format(" when it was to answer {} of '{}'", name_of(leaf.owed_first()),
                       leaf.caller->who);
  }
  return {};
}

void Conversation::take_line() {
  const std::string wrong = read_reply(reader_, line_, reply_);
  if (!wrong.empty()) {
    give_up(fmt::format("was killed, since it wrote {}, which is not an answer: {}{}", shown(line_),
                        wrong, blamed()));
    return;
  }
  std::string why = take_reply();
  answered_.notify_all();
  if (!why.empty()) give_up(std::move(why));
}

// "" or why it is no reply.
std::string Conversation::take_reply() {
  const Lock lock(mutex_);
  const bool is_known = reply_.leaf > 0 && reply_.leaf <= leaves_.size();
  Leaf* const leaf = is_known ? &leaves_[reply_.leaf - 1] : nullptr;
  const lockstep_caller* const caller = leaf != nullptr ? leaf->caller : run_;
  if (reply_.what == Reply::What::Log) {
    if (caller != nullptr) host_table().log(caller, reply_.level, reply_.text.c_str());
    return {};
  }
  if (reply_.what == Reply::What::Error && reply_.leaf == 0) {
    return fmt::format("has reported: {}", brief(reply_.text));
  }
  if (leaf == nullptr) {
    return fmt::format("was killed, since it spoke of leaf {}, which it does not have",
                       reply_.leaf);
  }
  if (reply_.what == Reply::What::Error) {
    take_error(*leaf);
  } else if (reply_.what == Reply::What::Progress) {
    leaf->progress = reply_.progress.value_or(leaf->progress);
    if (reply_.kept) leaf->kept = *std::move(reply_.kept);
  } else if (reply_.what == Reply::What::Pace) {
    leaf->least_pace = std::clamp(reply_.pace, 0.0, 1.0);
  } else {
    return take_answer(*leaf);
  }
  return {};
}

// An error is the answer to what was asked, if anything was.
void Conversation::take_error(Leaf& leaf) {
  constexpr std::size_t kLongest = 4096;  // the host cuts it off anyway
  if (leaf.news.error.empty()) leaf.news.error = reply_.text.substr(0, kLongest);
  if (std::exchange(leaf.owes_tick, false)) return;
  if (leaf.owed_first() == Asked::Pause) {
    --leaf.pauses;
  } else {
    leaf.has_erred = leaf.asked == Asked::Tick;
    leaf.asked = Asked::Nothing;
  }
}

// Answers come in the order of the questions: a tick is asked only when nothing is owed, and a halt
// is the last of its activation.
Conversation::Asked Conversation::Leaf::owed_first() const {
  if (owes_tick) return Asked::Tick;
  return pauses > 0 && asked != Asked::Tick ? Asked::Pause : asked;
}

// "" or why it is no answer.
std::string Conversation::take_answer(Leaf& leaf) {
  const bool is_status = reply_.what == Reply::What::Status;
  const Asked owed = leaf.owed_first();
  // An error that nobody asked for may have come just before the tick, and counted as its answer.
  if (is_status && owed != Asked::Tick && std::exchange(leaf.has_erred, false)) return {};
  if (owed == Asked::Nothing || is_status != (owed == Asked::Tick)) {
    return fmt::format("was killed, since it answered {} for '{}', which {}",
                       is_status ? "a status" : "'done'",
                       leaf.caller == nullptr ? "" : leaf.caller->who,
                       owed == Asked::Nothing ? "has no open request"
                                              : fmt::format("must answer {} first", name_of(owed)));
  }
  const bool is_halted = std::exchange(leaf.owes_tick, false);  // meanwhile
  if (is_halted && !leaf.is_condition) return {};
  if (reply_.kept) leaf.kept = *std::move(reply_.kept);
  if (owed == Asked::Pause) {
    --leaf.pauses;
    return {};
  }
  if (!is_halted) leaf.asked = Asked::Nothing;
  leaf.news.after_cut = reply_.after_cut;
  if (!is_status) {
    if (reply_.progress) leaf.progress = *reply_.progress;
    return {};
  }
  leaf.news.status = reply_.status;
  leaf.news.reason = reply_.reason;
  leaf.news.answered = monotonic_now();
  if (is_halted) return {};
  if (reply_.progress) leaf.progress = *reply_.progress;
  if (reply_.sets_ports) leaf.news.set = line_;
  return {};
}

void Conversation::begin_end() {
  was_gone_ = is_gone();
  closed_ = monotonic_now();
  if (!was_gone_) process_.close_input();
}

bool Conversation::await_end(RunningClock& clock, std::optional<Nanoseconds> until) {
  bool is_over = false;  // one that floods its output always has more to say
  while (!is_gone()) {
    const auto left = clock.wait_until(until);
    if (is_over || left == Nanoseconds(0)) {
      if (process_.await_end(left)) return true;
      if (left == Nanoseconds(0)) return false;
    } else if (process_.await_output(left)) {
      is_over = is_output_over();
      while (!is_gone() && process_.lines.next(line_)) take_line();
    }
  }
  return true;
}

void Conversation::hurry_end() {
  if (is_gone() || process_.has_ended()) return;
  is_hurried_ = true;
  process_.end_softly(options_.halt_limit);
}

std::string Conversation::end() {
  const auto limit = options_.halt_limit;
  const auto to_the_kill = limit ? std::optional(*limit + kToDie) : std::nullopt;
  if (was_gone_) {
    if (ends_softly()) process_.await_end(to_the_kill);
    return {};
  }
  if (is_gone()) return why_gone();
  const Nanoseconds waited = monotonic_now() - closed_;
  const auto how = process_.await_end(to_the_kill);
  if (!is_hurried_) return !how || *how == kGoodEnd ? "" : *how;
  const auto tenths = std::chrono::round<std::chrono::duration<int, std::deci>>(waited);
  return fmt::format("did not end for {:g} s after its input was closed; it was ended",
                     std::min(tenths.count() / 10.0, to_seconds(limit.value_or(waited))));
}

}  // namespace lockstep::host
