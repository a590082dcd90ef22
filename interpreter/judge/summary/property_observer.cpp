#include "judge/summary/property_observer.h"

#include <fmt/format.h>

#include <utility>

#include "base/core/wording.h"

namespace lockstep::host {

PropertyObserver::PropertyObserver(std::vector<Property> properties, Tell tell)
    : checks_(std::move(properties)), steps_(checks_), tell_(std::move(tell)) {}

void PropertyObserver::after_tick(const Moment& moment, const TickReport& report) {
  for (const std::size_t i : steps_.after_tick(moment)) {
    tell_(checks_.all()[i],
          fmt::format("in tick {}, at {:.3f} s", report.tick, to_seconds(report.time)));
  }
}

void PropertyObserver::run_ended(const Moment&, const RunEnd& end) {
  const bool by_itself = end.reason == StopReason::Completed || end.reason == StopReason::Fault;
  const auto how = by_itself ? RunIsOver::ByItself : RunIsOver::FromOutside;
  for (const std::size_t i : checks_.end(how)) {
    tell_(checks_.all()[i], fmt::format("at the end, after {}", counted(end.ticks, "tick")));
  }
}

void PropertyObserver::add_to(Summary& summary) const {
  for (std::size_t i = 0; i < checks_.all().size(); ++i) {
    const Property& it = checks_.all()[i];
    summary.properties.push_back({.name = it.name(),
                                  .text = it.text(),
                                  .verdict = checks_.verdict(i),
                                  .tick = checks_.decided(i)});
  }
}

}  // namespace lockstep::host
