#include "property/judged_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lockstep::host::test {

std::string LeafRule::row() const {
  std::string results;
  for (const auto& [may, word] :
       {std::pair(succeeds, "success"), std::pair(fails, "failure"), std::pair(skips, "skipped")}) {
    if (may) results += (results.empty() ? "" : ";") + std::string(word);
  }
  std::string row = fmt::format("<leaf path=\"*/{}\" result=\"{}\"", name, results);
  if (fact >= 0) row = fmt::format("<leaf path=\"*/{}\" fact=\"f{}\"", name, fact);
  if (!entry.empty()) row += " out.out=\"0|1\"";
  constexpr std::array kWrites{" writes=\"success\"", " writes=\"start\"", " writes=\"tick\"", ""};
  if (!entry.empty()) row += kWrites[static_cast<std::size_t>(writes)];
  constexpr std::array kAfterCuts{"restart", "continue", "failure", "success"};
  std::string does;
  for (const AfterCut it : after_cut) {
    does += (does.empty() ? "" : ";") + std::string(kAfterCuts[static_cast<std::size_t>(it)]);
  }
  if (!does.empty()) row += fmt::format(" on_resume=\"{}\"", does);
  if (!is_action) return row + "/>";
  if (sets >= 0) row += fmt::format(" sets=\"f{}={}\"", sets, sets_to);
  const std::string most = most_ticks == 0 ? "inf" : std::to_string(most_ticks);
  row += fmt::format(" ticks=\"{}..{}\"", least_ticks, most);
  if (parts == 0) return row + " progress=\"none\"/>";
  row += fmt::format(" progress=\"grid:{}\" step=\"{}..{}\"", parts, least_step, most_step);
  if (least_drift != 0 || most_drift != 0)
    row += fmt::format(" held=\"{}..{}\"", least_drift, most_drift);
  return row + (finishes_full ? " finish=\"full\"/>" : "/>");
}

JudgedLeaves::JudgedLeaves(std::vector<LeafRule> rules, const std::vector<FactRule>& facts)
    : rules_(std::move(rules)), leaves_(rules_.size()) {
  for (const FactRule& it : facts) facts_.push_back({.changes = it.changes});
}

void JudgedLeaves::keep(KeptState& state) {
  for (Leaf& it : leaves_) state(it.phase, it.ticks, it.level);
  for (Fact& it : facts_) state(it.value);
}

void JudgedLeaves::first_answers() {
  answers_.clear();
  counts_.clear();
}

bool JudgedLeaves::next_answers() {
  answers_.resize(at_);
  counts_.resize(at_);
  while (!answers_.empty() && answers_.back() + 1 == counts_.back()) {
    answers_.pop_back();
    counts_.pop_back();
  }
  if (answers_.empty()) return false;
  ++answers_.back();
  return true;
}

std::uint32_t JudgedLeaves::choose(std::uint32_t count) {
  if (count <= 1) return 0;
  if (at_ == answers_.size()) {
    answers_.push_back(0);
    counts_.push_back(count);
  }
  return answers_[at_++];
}

void JudgedLeaves::needs(bool holds, std::uint32_t leaf, const char* call) {
  if (!holds && broken_.empty()) broken_ = fmt::format("{} of {}", call, rules_[leaf].name);
}

void JudgedLeaves::say(std::uint32_t leaf, const std::string& word) {
  said_ += fmt::format("{}{}={}", said_.empty() ? "" : " ", rules_[leaf].name, word);
}

// "how far its progress goes in each tick that is withheld"
void JudgedLeaves::begin_tick() {
  at_ = 0;
  worked_ = ended_ = 0;
  said_.clear();
  for (Fact& it : facts_) {
    it.was_asked = false;
    if (it.changes == FactRule::Changes::Freely) it.value.reset();
  }
}

void JudgedLeaves::drift() {
  for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
    const LeafRule& rule = rules_[i];
    if (leaves_[i].phase != Phase::Held) continue;
    if (rule.least_drift == 0 && rule.most_drift == 0) continue;
    move(i, rule.least_drift, rule.most_drift, rule.parts);
    say(i, fmt::format("~{}", progress(i)));
  }
}

// "the same for all that name it within a tick"
bool JudgedLeaves::ask(Fact& fact) {
  using Changes = FactRule::Changes;
  const bool may_change = !fact.value || fact.changes == Changes::Freely ||
                          (fact.changes == Changes::Rises && !*fact.value) ||
                          (fact.changes == Changes::Falls && *fact.value);
  if (!fact.was_asked && may_change) fact.value = choose(2) == 0;
  fact.was_asked = true;
  return *fact.value;
}

void JudgedLeaves::move(std::uint32_t leaf, int least, int most, int highest) {
  int& level = leaves_[leaf].level;
  const int from = std::clamp(level + least, 0, highest);
  const int to = std::clamp(level + most, from, highest);
  level = from + static_cast<int>(choose(static_cast<std::uint32_t>(to - from + 1)));
}

void JudgedLeaves::start(std::uint32_t leaf) {
  needs(leaves_[leaf].phase == Phase::Idle, leaf, "start");
  leaves_[leaf] = {.phase = Phase::Running};
  if (rules_[leaf].writes == LeafRule::Writes::AtStart) write(leaf, false);
}

// "any: in any of its ticks, or not"
Status JudgedLeaves::tick(std::uint32_t leaf) {
  using Writes = LeafRule::Writes;
  const Writes writes = rules_[leaf].writes;
  const Status status = result(leaf);
  if (writes == Writes::InAnyTick) write(leaf, true);
  const bool has_succeeded = writes == Writes::WithSuccess && status == Status::Success;
  if (has_succeeded || writes == Writes::InEachTick) write(leaf, false);
  return status;
}

void JudgedLeaves::write(std::uint32_t leaf, bool may_leave_it) {
  if (rules_[leaf].entry.empty()) return;
  const std::uint32_t value = choose(may_leave_it ? 3 : 2);
  if (value == 2) return;
  write_(rules_[leaf].entry, value);
  said_ += fmt::format("[{}={}]", rules_[leaf].entry, value);
}

Status JudgedLeaves::result(std::uint32_t leaf) {
  const LeafRule& rule = rules_[leaf];
  Leaf& it = leaves_[leaf];
  needs(it.phase == Phase::Running, leaf, "tick");
  it.ticks = std::min(it.ticks + 1, std::max(rule.least_ticks, rule.most_ticks));
  if (rule.is_action) worked_ |= 1u << leaf;
  const bool may_end = it.ticks >= rule.least_ticks;
  const bool must_end = !rule.is_action || (rule.most_ticks > 0 && it.ticks >= rule.most_ticks);
  const bool is_full = it.level + rule.most_step >= rule.parts;
  const bool must_be_full = rule.finishes_full && it.level + rule.least_step >= rule.parts;

  if (rule.fact >= 0) {
    const bool holds = ask(facts_[static_cast<std::size_t>(rule.fact)]);
    return end(leaf, holds ? Status::Success : Status::Failure);
  }
  std::vector<Status> results;
  if (may_end && rule.succeeds && (!rule.finishes_full || is_full))
    results.push_back(Status::Success);
  if (may_end && rule.fails) results.push_back(Status::Failure);
  if (may_end && rule.skips) results.push_back(Status::Skipped);
  const bool may_run = !must_end && !(must_be_full && may_end && rule.succeeds);
  const int highest = rule.finishes_full ? rule.parts - 1 : rule.parts;
  const int from = std::clamp(it.level + rule.least_step, 0, std::max(highest, 0));
  const int to = std::clamp(it.level + rule.most_step, from, std::max(highest, 0));
  const auto levels = static_cast<std::uint32_t>(may_run ? to - from + 1 : 0);
  const std::uint32_t choice = choose(static_cast<std::uint32_t>(results.size()) + levels);
  if (choice < results.size()) {
    const Status result = results[choice];
    if (result == Status::Success && rule.sets >= 0) {
      Fact& fact = facts_[static_cast<std::size_t>(rule.sets)];
      fact.value = rule.sets_to;
      fact.was_asked = true;
    }
    return end(leaf, result);
  }
  it.level = from + static_cast<int>(choice - results.size());
  say(leaf, rule.parts == 0 ? "R" : fmt::format("R{}", progress(leaf)));
  return Status::Running;
}

Status JudgedLeaves::end(std::uint32_t leaf, Status result) {
  ended_ |= 1u << leaf;
  leaves_[leaf] = {};
  say(leaf, result == Status::Success ? "S" : result == Status::Failure ? "F" : "K");
  return result;
}

void JudgedLeaves::halt(std::uint32_t leaf) {
  needs(leaves_[leaf].phase != Phase::Idle, leaf, "halt");
  leaves_[leaf] = {};
  ended_ |= 1u << leaf;
}

void JudgedLeaves::pause(std::uint32_t leaf) {
  needs(leaves_[leaf].phase == Phase::Running, leaf, "pause");
  leaves_[leaf].phase = Phase::Held;
}

void JudgedLeaves::resume(std::uint32_t leaf) {
  needs(leaves_[leaf].phase == Phase::Held, leaf, "resume");
  leaves_[leaf].phase = Phase::Running;
}

AfterCut JudgedLeaves::cut(std::uint32_t leaf, bool has_ticked) {
  std::vector<AfterCut> may = rules_[leaf].after_cut;
  if (!has_ticked) std::erase(may, AfterCut::Continues);
  if (may.empty()) may.push_back(AfterCut::StartsAgain);
  const AfterCut does = may[choose(static_cast<std::uint32_t>(may.size()))];
  if (does != AfterCut::Continues) leaves_[leaf] = {};
  constexpr std::array kWords{"|", "|goes on", "|F", "|S"};
  say(leaf, kWords[static_cast<std::size_t>(does)]);
  return does;
}

double JudgedLeaves::progress(std::uint32_t leaf) const {
  const int parts = rules_[leaf].parts;
  return parts == 0 ? 0 : static_cast<double>(leaves_[leaf].level) / parts;
}

}  // namespace lockstep::host::test
