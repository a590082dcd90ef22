#include "leaves/remote/json_lines/program_leaf.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/call_mark.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/remote/json_lines/port_json.h"

namespace lockstep::host {
namespace {

using Asked = Conversation::Asked;

// An answer that comes later than this is worth a line.
constexpr Nanoseconds kLate = std::chrono::milliseconds(100);

}  // namespace

ProgramLeaf::ProgramLeaf(const lockstep_caller& caller, Conversation& conversation, Hold hold,
                         Listener* listener)
    : RemoteLeaf(caller),
      conversation_(conversation),
      hold_(hold),
      listener_(listener),
      number_(conversation.add(caller)),
      is_condition_(caller.type->leaf->kind == LOCKSTEP_CONDITION),
      last_(*caller.time, conversation.options()) {}

void ProgramLeaf::end() {
  if (!conversation_.is_gone()) {
    // The run is over: the time for a halt that was asked for in its last tick.
    conversation_.await(number_, Asked::Halt, conversation_.options().halt_limit);
    request_.clear();
    request_.begin("destroy", number_).end();
    if (is_made_) send(Asked::Nothing);
  }
  conversation_.remove(number_);
}

bool ProgramLeaf::has_error() const {
  return caller_.slot->error != nullptr;
}

double ProgramLeaf::now() const {
  return host_table().now(&caller_);
}

bool ProgramLeaf::send(Conversation::Asked asked) {
  if (!request_.too_long().empty()) {
    fail(request_.too_long());
    return false;
  }
  conversation_.send(number_, asked, request_.text());
  if (listener_ != nullptr) listener_->wake();
  return true;
}

std::string ProgramLeaf::why_gone() {
  return conversation_.is_gone() ? "its program " + conversation_.why_gone() : std::string();
}

bool ProgramLeaf::fail_if_gone() {
  const std::string why = why_gone();
  if (!why.empty()) fail(why);
  return !why.empty();
}

// Waits as long as a call of a plugin may take.
bool ProgramLeaf::await(Asked asked) {
  CallMark::this_thread().set_bounded();
  if (conversation_.await(number_, asked, conversation_.hang_limit())) return true;
  conversation_.give_up(fmt::format("did not answer {} of '{}' for {:g} s; it was killed",
                                    name_of(asked), caller_.who,
                                    to_seconds(conversation_.options().hang_limit)));
  fail_if_gone();
  return false;
}

bool ProgramLeaf::create() {
  if (fail_if_gone()) return false;
  request_.clear();
  request_.begin("create", number_)
      .field("type", std::string_view(caller_.type->leaf->id))
      .field("name", std::string_view(texts_of(caller_).name))
      .field("path", std::string_view(caller_.who))
      .field("period", host_table().tick_period(&caller_))
      .field("clock", std::string_view(is_waiting() ? "virtual" : "wall"))
      .field("seed", host_table().random_bits(&caller_) >> 11)  // exact as a double
      .fixed(caller_)
      .unbound(caller_)
      .end();
  is_made_ = send(Asked::Create);
  if (!is_made_ || !await(Asked::Create)) return false;
  const auto news = conversation_.take(number_);
  if (!news.error.empty()) fail(news.error);
  return news.error.empty();
}

// It is sent with the first tick, which may be later than this: when the last halt is answered.
void ProgramLeaf::start() {
  factor_.reset();
  reason_.clear();
  has_begun_ = false;
  if (!is_condition_) conversation_.forget(number_);
}

// Until the next answer, the reason is that of the last one. A fault has its own text.
lockstep_status ProgramLeaf::tick() {
  const lockstep_status status = result();
  if (!reason_.empty() && !has_error()) take_reason(caller_, Shortened(reason_));
  return status;
}

lockstep_status ProgramLeaf::result() {
  if (fail_if_gone()) return LOCKSTEP_RUNNING;
  if (is_waiting()) return tick_and_wait();
  return is_condition_ ? tick_condition() : tick_without_waiting();
}

void ProgramLeaf::ask_tick() {
  request_.clear();
  if (!has_begun_) {
    sent_.clear();
    request_.begin("start", number_).field("now", now()).ports(caller_, sent_).end();
  }
  if (factor_) request_.begin("set_pace", number_).field("factor", *factor_).end();
  factor_.reset();
  request_.begin("tick", number_).field("now", now()).ports(caller_, sent_).end();
  if (!has_error() && send(Asked::Tick)) has_begun_ = true;
}

lockstep_status ProgramLeaf::tick_and_wait() {
  ask_tick();
  if (has_error() || !await(Asked::Tick)) return LOCKSTEP_RUNNING;
  return take(conversation_.take(number_));
}

lockstep_status ProgramLeaf::tick_without_waiting() {
  const auto news = conversation_.take(number_);
  if (news.is_asked) {
    end_if_hanging(news.since);
    note_late(news.since);
    return fail_if_gone() ? LOCKSTEP_RUNNING : take({.error = news.error});
  }
  const lockstep_status status = take(news);
  if (!has_error() && status == LOCKSTEP_RUNNING) ask_tick();
  return status;
}

// Each activation asks anew. A question that is still open was asked by an earlier tick, which has
// waited for it; its answer becomes the last result when it comes.
lockstep_status ProgramLeaf::tick_condition() {
  last_.begin_tick();
  auto news = conversation_.take(number_);
  bool is_open = news.is_asked;
  if (!keep_result(news)) return LOCKSTEP_RUNNING;
  if (!is_open) {
    news.since = conversation_.now();
    is_open = !ask_and_await_answer();
    if (has_error() || !keep_result(conversation_.take(number_))) return LOCKSTEP_RUNNING;
  }
  if (!is_open) return last_.status();
  end_if_hanging(news.since);
  if (fail_if_gone()) return LOCKSTEP_RUNNING;
  const lockstep_status status = last_.now();
  if (status != LOCKSTEP_RUNNING) return status;
  if (const std::string late = last_.warning(); !late.empty()) {
    host_table().log(&caller_, LOCKSTEP_LOG_WARNING, late.c_str());
  }
  return LOCKSTEP_RUNNING;
}

// False: the leaf has an error.
bool ProgramLeaf::keep_result(Conversation::News news) {
  const bool is_answered = news.status != 0;
  const Nanoseconds ago = monotonic_now() - news.answered;
  const lockstep_status status = take(std::move(news));
  if (has_error()) return false;
  if (is_answered) last_.keep(status, ago);
  return true;
}

// False: the time that this tick may wait is over.
bool ProgramLeaf::ask_and_await_answer() {
  const Listener::Hurry hurry(*listener_);
  ask_tick();
  if (has_error()) return false;
  const Nanoseconds began = monotonic_now();
  const bool is_there = conversation_.await(number_, Asked::Tick, last_.patience());
  last_.note_wait(monotonic_now() - began);
  return !fail_if_gone() && is_there;
}

lockstep_status ProgramLeaf::take(Conversation::News news) {
  if (news.status != 0) reason_ = std::move(news.reason);
  if (news.error.empty() && is_condition_ && news.status == LOCKSTEP_RUNNING) {
    fail(kRunningCondition);
  } else if (!news.error.empty()) {
    fail(news.error);
  } else if (!news.set.empty()) {
    set_ports(std::move(news.set));
  }
  return news.status == 0 ? LOCKSTEP_RUNNING : news.status;
}

void ProgramLeaf::set_ports(std::string line) {
  std::string wrong;
  const auto set = [&](std::string_view name, JsonValue value) {
    const auto port = std::ranges::find(caller_.ports, name, &BoundPort::name);
    if (port == caller_.ports.end()) {
      if (wrong.empty()) wrong = fmt::format("set '{}', which is not one of its ports", name);
      return value.skip();
    }
    const auto index = static_cast<std::uint32_t>(port - caller_.ports.begin());
    if (std::string why = set_port(caller_, index, value); wrong.empty()) wrong = std::move(why);
    if (index >= sent_.size() || is_same(port_value(caller_, index), sent_[index])) return;
    sent_[index] = Object();  // which none is: the program has its own value now
  };
  try {
    reader_.read(line, [&](JsonObject object) {
      object.read({{"set", [&](JsonValue ports) { ports.object().each_field(set); }}});
    });
  } catch (const JsonError& error) {
    wrong = error.what();
  }
  if (!wrong.empty()) fail(wrong);
}

void ProgramLeaf::end_if_hanging(Nanoseconds since) {
  const auto limit = conversation_.hang_limit();
  if (limit && conversation_.now() - since > *limit) {
    conversation_.give_up(fmt::format("did not answer '{}' for {:g} s; it was killed", caller_.who,
                                      to_seconds(*limit)));
  }
}

// Nothing is wrong yet: the leaf has the progress that it had.
void ProgramLeaf::note_late(Nanoseconds since) {
  if (conversation_.is_gone() || told_late_ == since || conversation_.now() - since <= kLate)
    return;
  told_late_ = since;
  host_table().log(&caller_, LOCKSTEP_LOG_WARNING,
                   fmt::format("its program is late: no answer for {:g} s; until then it stays "
                               "running",
                               to_seconds(kLate))
                       .c_str());
}

void ProgramLeaf::halt() {
  if (conversation_.is_gone()) return;  // where there is no process, there is nothing to halt
  if (!has_begun_) return;
  request_.clear();
  request_.begin("halt", number_).field("now", now()).end();
  send(Asked::Halt);
  if (std::exchange(is_held_, false)) conversation_.process().go_on();
  // At the end of a run there is no tick to lose, and whether the leaf stands still counts.
  if (listener_ != nullptr && !caller_.run->node_context->in_last_halt()) return;
  const auto limit = conversation_.options().halt_limit;
  if (!conversation_.await(number_, Asked::Halt, limit)) {
    conversation_.check_deadline();
    fail_if_gone();
  } else if (const auto news = conversation_.take(number_); !news.error.empty()) {
    fail(news.error);
  }
}

void ProgramLeaf::pause() {
  if (fail_if_gone() || !has_begun_) return;
  if (hold_ == Hold::Signal) return stop();
  request_.clear();
  request_.begin("pause", number_).field("now", now()).end();
  if (hold_ != Hold::Answered) {
    send(Asked::Nothing);
    return;
  }
  send(Asked::Pause);
  if (!is_waiting() || !await(Asked::Pause)) return;
  if (const auto news = conversation_.take_error(number_); !news.error.empty()) fail(news.error);
}

void ProgramLeaf::stop() {
  is_held_ = true;
  conversation_.process().hold();
}

// While it is held, on the wall clock. A process that is stopped answers later.
std::string ProgramLeaf::trouble() {
  if (conversation_.is_gone()) return why_gone();
  auto news = conversation_.take_error(number_);
  if (!news.error.empty() || !news.is_asked || hold_ == Hold::Signal) return std::move(news.error);
  end_if_hanging(news.since);
  note_late(news.since);
  return why_gone();
}

void ProgramLeaf::resume() {
  if (fail_if_gone() || !has_begun_) return;
  conversation_.forgive(number_);
  if (hold_ == Hold::Signal) {
    is_held_ = false;
    return conversation_.process().go_on();
  }
  request_.clear();
  request_.begin("resume", number_).field("now", now()).end();
  send(Asked::Nothing);
}

// It owes no answer. What it takes up is what it was asked, or the least that it has said.
double ProgramLeaf::set_pace(double factor) {
  factor_ = factor;
  return std::max(factor, conversation_.least_pace(number_));
}

std::size_t ProgramLeaf::save(void* bytes, std::size_t room) {
  const std::string kept = conversation_.kept(number_);
  if (kept.size() <= room) std::ranges::copy(kept, static_cast<char*>(bytes));
  return kept.size();
}

// Before the first tick, so it may take its time.
lockstep_after_cut ProgramLeaf::restore(const void* bytes, std::size_t size,
                                        const lockstep_cut* cut) {
  start();
  if (fail_if_gone()) return LOCKSTEP_STARTS_AGAIN;
  const std::string_view kept(static_cast<const char*>(bytes), size);
  conversation_.keep(number_, kept);  // until it sends another one
  sent_.clear();
  request_.clear();
  request_.begin("restore", number_)
      .field("now", now())
      .field("kept", kept)
      .flag("power", cut->power)
      .flag("held", cut->held)
      .field("gap", cut->gap)
      .field("lost_ticks", cut->lost_ticks)
      .field("on_resume", std::string_view(cut->on_resume == LOCKSTEP_SUCCESS   ? "success"
                                           : cut->on_resume == LOCKSTEP_FAILURE ? "failure"
                                                                                : "restart"))
      .ports(caller_, sent_)
      .end();
  if (!send(Asked::Restore) || !await(Asked::Restore)) return LOCKSTEP_STARTS_AGAIN;
  const auto news = conversation_.take(number_);
  if (!news.error.empty()) fail(news.error);
  has_begun_ = news.after_cut == LOCKSTEP_CONTINUES;
  // The process of the run before was stopped. This one has to answer first.
  if (has_begun_ && cut->held && hold_ == Hold::Signal) stop();
  return news.after_cut;
}

double ProgramLeaf::progress() {
  return conversation_.progress(number_);
}

}  // namespace lockstep::host
