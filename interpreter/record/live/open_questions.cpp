#include "record/live/open_questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/diagnostics.h"

namespace lockstep::host {
namespace {

// A node that a fault ends before it asks, such as a timeout below 0, stays Running and has no
// text.
bool has_failed(const Moment& moment, NodeIndex node) {
  return moment.live != nullptr && moment.live->faulted() && moment.reason(node).empty();
}

}  // namespace

OpenQuestions::OpenQuestions(const Shape& shape, Tell tell, std::function<void()> on_change)
    : shape_(shape), tell_(std::move(tell)), on_change_(std::move(on_change)) {
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    if (shape.nodes[node].question) asking_.push_back(node);
  }
}

std::vector<OpenQuestion> OpenQuestions::now() const {
  const Lock lock(mutex_);
  return now_;
}

std::optional<GivenAnswer> OpenQuestions::answer_to(NodeIndex node, std::uint64_t tick) const {
  const Lock lock(mutex_);
  for (const Answered& it : answered_) {
    if (it.question.node == node && it.question.tick == tick) return it.answer;
  }
  return std::nullopt;
}

void OpenQuestions::after_tick(const Moment& moment, const TickReport&) {
  bool is_changed = false;
  for (const GivenAnswer& it : moment.answers) given_.insert_or_assign(it.node, it);
  for (const NodeIndex node : asking_) {
    const bool asks = moment.status(node) == Status::Running;
    const Lock lock(mutex_);  // nobody holds it for long
    const auto it = std::ranges::find(now_, node, &OpenQuestion::node);
    // One that was held at a cut has no text until its next tick. It may also have its answer.
    const bool begins = asks && moment.state(node).ticked() && !has_failed(moment, node);
    // The answer may be to a question that was asked before a cut, which is not open here.
    const OpenQuestion before_cut{node, {}};
    const bool has_answer = it == now_.end() && given_.contains(node);
    if (has_answer && is_over(moment, before_cut)) end(moment, before_cut);
    if (it == now_.end() ? !begins : !is_over(moment, *it)) continue;
    is_changed = true;
    if (it != now_.end()) {
      end(moment, *it);
      now_.erase(it);
    }
    if (!asks) continue;
    now_.push_back({node, std::string(moment.reason(node)), moment.tick, moment.time});
    std::string options;
    for (const std::string& option : shape_.nodes[node].question->options) {
      options += (options.empty() ? "" : ", ") + option;
    }
    tell_(fmt::format("{} asks: {} ({})", printable(shape_.nodes[node].path),
                      printable(now_.back().text), printable(options)));
  }
  if (is_changed) on_change_();
}

bool OpenQuestions::is_over(const Moment& moment, const OpenQuestion& question) const {
  if (moment.status(question.node) != Status::Running) return true;
  if (given_.contains(question.node)) return moment.state(question.node).ticked();
  return question.text != moment.reason(question.node);
}

void OpenQuestions::end(const Moment& moment, const OpenQuestion& question) {
  constexpr std::size_t kMost = 1000;
  const std::string path = printable(shape_.nodes[question.node].path);
  const auto given = given_.extract(question.node);
  if (given && moment.state(question.node).ticked()) {
    const GivenAnswer& answer = given.mapped();
    tell_(fmt::format("{}: {} (by {})", path, printable(answer.answer), answer.who));
    answered_.push_back({question, answer});
    if (answered_.size() > kMost) answered_.pop_front();
    return;
  }
  if (given) {
    const GivenAnswer& answer = given.mapped();
    return tell_(fmt::format("{}: halted before it took the answer {} (by {})", path,
                             printable(answer.answer), answer.who));
  }
  const bool is_halted = moment.status(question.node) == Status::Idle;
  const std::string why(moment.reason(question.node));
  tell_(fmt::format("{}: {}", path, is_halted || why.empty() ? "halted before an answer" : why));
}

void OpenQuestions::run_ended(const Moment&, const RunEnd&) {
  given_.clear();
  const Lock lock(mutex_);
  now_.clear();
}

bool asks_people(const Shape& shape) {
  return std::ranges::any_of(shape.nodes,
                             [](const ShapeNode& it) { return it.question != nullptr; });
}

}  // namespace lockstep::host
