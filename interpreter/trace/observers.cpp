#include "trace/observers.h"

namespace lockstep::host {
namespace {

AskedOfRun asked_by(std::span<Observer* const> observers) {
  AskedOfRun all;
  for (const Observer* const it : observers) {
    const AskedOfRun asked = it->asked();
    all.progress.insert(all.progress.end(), asked.progress.begin(), asked.progress.end());
    all.parallels.insert(all.parallels.end(), asked.parallels.begin(), asked.parallels.end());
    all.within |= asked.within;
  }
  return all;
}

}  // namespace

Observers::Observers(const Tree& tree, std::span<Observer* const> observers)
    : observers_(observers.begin(), observers.end()), moments_(tree, asked_by(observers)) {}

void Observers::run_started(Ticker& ticker, const RunStart& start) {
  for (Observer* const it : observers_) it->run_started(ticker, start);
}

void Observers::before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  for (Observer* const it : observers_) it->before_tick(ticker, tick, time);
  moments_.before_tick(ticker);
}

void Observers::after_tick(Ticker& ticker, TickReport report) {
  report.moment = &moments_.after_tick(ticker, report.tick, report.time);
  for (Observer* const it : observers_) it->after_tick(ticker, report);
}

void Observers::standing(Ticker& ticker) {
  for (Observer* const it : observers_) it->standing(ticker);
}

void Observers::run_ended(Ticker& ticker, const RunEnd& end) {
  for (Observer* const it : observers_) it->run_ended(ticker, end);
}

}  // namespace lockstep::host
