#include "embedding/run_properties.h"

#include <fmt/format.h>

#include <utility>

#include "base/core/wording.h"
#include "run/shape_of.h"

namespace lockstep::host::embedding {

std::optional<Problem> RunProperties::add(std::string_view text) {
  auto property = Property::parse(text, property_names(shape_of(tree_)));
  if (!property) {
    const PropertyError& it = property.error();
    return Problem{fmt::format("'{}', column {}: {}", brief(text), it.offset + 1, it.message),
                   it.hint};
  }
  add(std::span(&*property, 1));
  return std::nullopt;
}

void RunProperties::add(std::span<const Property> properties) {
  properties_.insert(properties_.end(), properties.begin(), properties.end());
  make();
}

void RunProperties::begin_again() {
  kept_.reset();
  make();
}

void RunProperties::go_on(const KeptProperties& kept) {
  kept_ = kept;
  make();
}

void RunProperties::make() {
  checks_.emplace(properties_);
  if (!empty()) steps_.emplace(*checks_);
  is_over_ = false;
  violations_.clear();
  fresh_.clear();
  if (!kept_) return;
  fresh_ = checks_->go_on(*kept_);
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    if (checks_->verdict(i) != PropertyVerdict::Violated) continue;
    const auto tick = checks_->decided(i);
    violations_.push_back(fmt::format("{}: violated {}before the cut", properties_[i].name(),
                                      tick ? fmt::format("in tick {}, ", *tick) : ""));
  }
}

void RunProperties::after_tick(const Moment& moment, const TickReport& report) {
  if (is_over_ || !steps_) return;
  for (const std::size_t i : steps_->after_tick(moment)) {
    violations_.push_back(fmt::format("{}: violated in tick {}, at {:.3f} s",
                                      checks_->all()[i].name(), report.tick,
                                      to_seconds(report.time)));
  }
  if (report.status != Status::Running || moment.live->faulted()) {
    end(RunIsOver::ByItself, report.tick + 1);
  }
}

void RunProperties::run_ended(const Moment&, const RunEnd& end_of_run) {
  const bool by_itself =
      end_of_run.reason == StopReason::Completed || end_of_run.reason == StopReason::Fault;
  end(by_itself ? RunIsOver::ByItself : RunIsOver::FromOutside, end_of_run.ticks);
}

void RunProperties::end(RunIsOver how, std::uint64_t ticks) {
  if (std::exchange(is_over_, true)) return;
  for (const std::size_t i : checks_->end(how)) {
    violations_.push_back(fmt::format("{}: violated at the end, after {}", checks_->all()[i].name(),
                                      counted(ticks, "tick")));
  }
}

}  // namespace lockstep::host::embedding
