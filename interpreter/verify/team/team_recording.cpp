#include "verify/team/team_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "record/write/recorder.h"
#include "run/observers.h"
#include "run/run.h"
#include "run/shape_of.h"
#include "verify/same_tick.h"
#include "verify/trace.h"

namespace lockstep::host {
namespace {

class PeriodClock final : public Clock {
 public:
  Nanoseconds now() override { return time; }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return false; }
  Nanoseconds time{0};
};

// One of them, in a real run.
class ReplayedRobot {
 public:
  ReplayedRobot(const RecordedRobot& robot, const TeamTree& tree, std::size_t number,
                const TeamFinding& finding, double rate)
      : period_(from_seconds(1 / rate)),
        tree_(tree.tree),
        team_(tree.tree, tree.teams, TeamCode::run_of(number), transport_, clock_),
        recorder_(shape_of(tree.tree), options(robot, number, finding, rate)),
        rate_(rate) {}

  const std::string& error() const { return recorder_.error(); }

  void begin() {
    team_.use_here();
    run_.emplace(tree_, RunOptions{.rate = rate_, .virtual_time = true});
    observers_.emplace(tree_, std::span<Observer* const>(list_));
    observers_->run_started(run_->ticker(), {.period = period_, .real_time = false});
  }
  void tick(Nanoseconds now, std::vector<HeardWord> heard) {
    clock_.time = now;
    for (HeardWord& it : heard) it.at += now;
    transport_.given = std::move(heard);
    run_->set_now(time_);
    observers_->before_tick(run_->ticker(), ticks_, time_);
    const Status status = run_->tick();
    observers_->after_tick(run_->ticker(), {.tick = ticks_++, .time = time_, .status = status});
    if (status != Status::Running || run_->fault() != nullptr) end(StopReason::Completed, status);
    time_ += period_;
    said_.push_back(transport_.said);
  }
  void say_nothing() { said_.emplace_back(); }
  void stop() {
    if (run_ && !has_ended_) end(StopReason::MaxTicks, Status::Running);
  }
  // What it said so many turns ago.
  const TeamWord& said(std::uint32_t turns, std::size_t team) const {
    return said_[said_.size() - 1 - turns][team];
  }
  const Ticker& ticker() { return run_->ticker(); }

 private:
  static RecorderOptions options(const RecordedRobot& robot, std::size_t number,
                                 const TeamFinding& finding, double rate) {
    RecorderOptions options;
    options.path = robot.path;
    options.run = {.tree_file = robot.file,
                   .rate_hz = rate,
                   .verify = fmt::format("{}: {}", finding.name, finding.message)};
    options.run.arguments = values_of(robot.runnable.arguments);
    options.run.values = robot.runnable.values;
    options.run.run = TeamRun::short_run(TeamCode::run_of(number));
    return options;
  }
  void end(StopReason reason, Status status) {
    const std::optional<Fault> fault =
        run_->fault() != nullptr ? std::optional(*run_->fault()) : std::nullopt;
    RunEnd end;
    end.reason = fault ? StopReason::Fault : reason;
    end.status = status;
    end.fault = fault;
    end.ticks = ticks_;
    end.time = time_ + period_;
    end.last = time_;
    observers_->run_ended(run_->ticker(), end);
    has_ended_ = true;
  }

  const Nanoseconds period_;
  const Tree& tree_;
  PeriodClock clock_;
  HeldTransport transport_;
  TeamRun team_;
  Recorder recorder_;
  const double rate_;
  Observer* list_[2] = {&team_, &recorder_};
  std::optional<Run> run_;
  std::optional<Observers> observers_;
  std::vector<std::vector<TeamWord>> said_;
  std::uint64_t ticks_ = 0;
  Nanoseconds time_{0};
  bool has_ended_ = false;
};

// Whether the word that is heard in this turn came long before it: its robot is silent a tick
// earlier then, in a later turn.
bool comes_early(const std::vector<TeamTurn>& run, std::size_t turn, const TeamTurn::Hears& heard) {
  const auto is_of = [&](const auto& it) {
    return it.team == heard.team && it.other == heard.other;
  };
  for (std::size_t i = turn + 1; i < run.size(); ++i) {
    if (run[i].robot != run[turn].robot) continue;
    if (std::ranges::any_of(run[i].hears, is_of)) return false;
    if (std::ranges::any_of(run[i].silent, is_of)) return true;
  }
  return false;
}

std::vector<LeafScripts> scripts_of(TeamSearch& search, const TeamFinding& finding,
                                    const std::vector<TeamTree>& trees, double rate) {
  std::vector<LeafScripts> scripts(trees.size());
  for (LeafScripts& it : scripts) it.rate = rate, it.ticks = 0;
  std::vector<std::unique_ptr<ScriptWriter>> writers(trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    writers[i] = std::make_unique<ScriptWriter>(trees[i].tree, trees[i].models,
                                                search.robot(i).stepper(), scripts[i]);
  }
  search.play(finding.run, [&](const TeamTurn& turn, SearchedRobot&) {
    if (!turn.ticks) return;
    writers[turn.robot]->add_tick();
    ++*scripts[turn.robot].ticks;
  });
  return scripts;
}

}  // namespace

Result<std::string> record_team(TeamSearch& search, const TeamFinding& finding,
                                const std::vector<TeamTree>& trees,
                                const std::vector<RecordedRobot>& robots, double rate) {
  const auto scripts = scripts_of(search, finding, trees, rate);
  std::vector<std::unique_ptr<ReplayedRobot>> replayed;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    replayed.emplace_back();
    if (robots[i].path.empty()) continue;
    robots[i].played.set_scripts(scripts[i]);
    replayed.back() = std::make_unique<ReplayedRobot>(robots[i], trees[i], i, finding, rate);
    if (!replayed.back()->error().empty()) return problem(replayed.back()->error());
  }
  std::string wrong;
  std::size_t turns = 0;
  search.play(finding.run, [&](const TeamTurn& turn, SearchedRobot& searched) {
    const std::size_t number = turns++;
    if (replayed[turn.robot] == nullptr) return;
    ReplayedRobot& robot = *replayed[turn.robot];
    const auto period = static_cast<std::int64_t>(number / robots.size());
    const Nanoseconds length = from_seconds(1 / rate);
    if (!turn.ticks) return robot.say_nothing();
    if (turn.begins) robot.begin();
    std::vector<HeardWord> heard;
    for (const TeamTurn::Hears& it : turn.hears) {
      const TeamLink link = search.link(turn.robot, it);
      heard.push_back(
          {.team = static_cast<std::uint32_t>(it.team),
           .member = static_cast<std::uint32_t>(it.other),
           .word = replayed[link.robot]->said(it.age, link.team),
           .at = comes_early(finding.run, number, it) ? -almost(length) : Nanoseconds(0)});
    }
    robot.tick(period * length, std::move(heard));
    if (!wrong.empty()) return;
    wrong = difference(robot.ticker(), searched.stepper().ticker());
    if (!wrong.empty())
      wrong = fmt::format("in period {}, {}: {}", period, search.name(turn.robot), wrong);
  });
  for (const auto& it : replayed) {
    if (it == nullptr) continue;
    it->stop();
    if (!it->error().empty()) return problem(it->error());
  }
  return wrong;
}

}  // namespace lockstep::host
