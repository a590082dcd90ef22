#include "embedding/run_watchers.h"

#include <utility>

#include "base/core/deadlines.h"
#include "record/part_names.h"
#include "run/shape_of.h"
#include "show/web/server_socket.h"

namespace lockstep::host::embedding {

RunWatchers::RunWatchers(const Tree& tree, RunDescription run, RunStart start)
    : tree_(tree), run_(std::move(run)), start_(start) {}

void RunWatchers::go_on(std::uint64_t first_tick, Nanoseconds gap,
                        std::span<const std::uint32_t> set, std::string text) {
  start_.first_tick = first_tick;
  start_.gap = gap;
  set_.assign(set.begin(), set.end());
  start_.set = set_;
  resumed_ = std::move(text);
}

std::optional<Problem> RunWatchers::record(std::string file,
                                           std::function<void(const std::string& error)> on_error) {
  if (recorder_) return Problem{"the run is recorded already", "one recording for each run"};
  if (!resumed_.empty()) file = name_of_resumed(file);
  const Lock lock(mutex_);
  recorder_.emplace(shape_of(tree_),
                    RecorderOptions{.path = file, .run = run_, .on_error = std::move(on_error)});
  if (recorder_->error().empty()) {
    observers_.push_back(&*recorder_);
    if (!resumed_.empty()) recorder_->log("lockstep", "info", resumed_);
    return std::nullopt;
  }
  Problem wrong{recorder_->error(), ""};
  recorder_.reset();
  return wrong;
}

Result<std::string> RunWatchers::monitor(const std::string& address) {
  if (monitor_) return problem("the run has a monitor already", "one monitor for each run");
  auto socket = listen_on(address);
  if (!socket) return tl::unexpected(std::move(socket.error()));
  const Lock lock(mutex_);
  monitor_.emplace(shape_of(tree_), MonitorOptions{.run = run_});
  observers_.push_back(&*monitor_);
  if (!resumed_.empty()) monitor_->log("lockstep", "info", resumed_);
  return monitor_->open(std::move(*socket));
}

void RunWatchers::show_groot(std::unique_ptr<Observer> groot, Ticker& ticker) {
  std::erase(observers_, groot_.get());
  groot_ = std::move(groot);
  if (groot_ != nullptr) observers_.push_back(groot_.get());
  if (all_) all_.emplace(tree_, observers_);
  if (groot_ == nullptr) return;
  const bool has_ticked = ticker.tick_number() != start_.first_tick;
  if (is_begun_ || has_ticked) {
    groot_->run_started(LiveMoments(tree_).now(ticker), start_);
  }
  is_begun_ = is_begun_ || has_ticked;
}

void RunWatchers::log(std::string_view who, std::string_view level, std::string_view text) {
  const Lock lock(mutex_);
  if (recorder_) recorder_->log(who, level, text);
  if (monitor_) monitor_->log(who, level, text);
}

void RunWatchers::before_tick(Ticker& ticker, Nanoseconds time) {
  if (!all_) all_.emplace(tree_, observers_);
  if (!std::exchange(is_begun_, true)) all_->run_started(ticker, start_);
  all_->before_tick(ticker, ticker.tick_number(), time);
}

void RunWatchers::after_tick(Ticker& ticker, const TickReport& report) {
  status_ = report.status;
  all_->after_tick(ticker, report);
}

void RunWatchers::halted(Ticker& ticker, Nanoseconds time) {
  if (!is_begun_ || groot_ == nullptr) return;
  Observer* const groot = groot_.get();
  Observers(tree_, {&groot, 1})
      .after_tick(ticker, {.tick = ticker.tick_number(), .time = time, .status = Status::Idle});
}

void RunWatchers::end(Ticker& ticker, Nanoseconds last) {
  if (std::exchange(is_begun_, false)) {
    RunEnd end;
    end.status = status_;
    end.first_tick = start_.first_tick;
    end.ticks = ticker.tick_number();
    end.time = end.last = last;
    if (!start_.real_time) {  // there, the last one lasts until the next would begin
      const Deadlines deadlines(run_.rate_hz);
      end.time = deadlines.at(deadlines.first_from(last + Nanoseconds(1)));
    }
    if (ticker.fault() != nullptr) {
      end.reason = StopReason::Fault;
      end.fault = *ticker.fault();
    } else if (!has_ended(status_)) {
      end.reason = StopReason::Stopped;
    }
    LiveMoments moments(tree_);
    for (Observer* const it : observers_) it->run_ended(moments.now(ticker), end);
  }
  all_.reset();
  go_on(0, Nanoseconds(0), {}, {});
  observers_.clear();
  groot_.reset();
  const Lock lock(mutex_);
  recorder_.reset();
  monitor_.reset();
}

}  // namespace lockstep::host::embedding
