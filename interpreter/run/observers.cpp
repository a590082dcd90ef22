#include "run/observers.h"

namespace lockstep::host {
namespace {

AskedOfRun asked_by(std::span<Observer* const> observers) {
  AskedOfRun all;
  for (const Observer* const it : observers) {
    const AskedOfRun asked = it->asked();
    all.progress.insert(all.progress.end(), asked.progress.begin(), asked.progress.end());
    all.parallels.insert(all.parallels.end(), asked.parallels.begin(), asked.parallels.end());
    all.within |= asked.within;
    all.progress_within |= asked.progress_within;
    if (!asked.heard.empty()) all.heard = asked.heard;
    if (asked.stood_still != nullptr) all.stood_still = asked.stood_still;
  }
  return all;
}

}  // namespace

Observers::Observers(const Tree& tree, std::span<Observer* const> observers)
    : observers_(observers.begin(), observers.end()), moments_(tree, asked_by(observers)) {}

void Observers::run_started(Ticker& ticker, const RunStart& start) {
  moments_.begin(ticker);
  const Moment& moment = moments_.now(ticker);
  for (Observer* const it : observers_) it->run_started(moment, start);
}

void Observers::before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  const Moment& moment = moments_.now(ticker);
  for (Observer* const it : observers_) it->before_tick(moment, tick, time);
  moments_.before_tick(ticker);
}

void Observers::after_tick(Ticker& ticker, const TickReport& report) {
  const Moment& moment = moments_.after_tick(ticker, report.tick, report.time);
  for (Observer* const it : observers_) it->after_tick(moment, report);
}

void Observers::standing(Ticker& ticker) {
  const Moment& moment = moments_.now(ticker);
  for (Observer* const it : observers_) it->standing(moment);
}

void Observers::run_ended(Ticker& ticker, const RunEnd& end) {
  const Moment& moment = moments_.now(ticker);
  for (Observer* const it : observers_) it->run_ended(moment, end);
}

}  // namespace lockstep::host
