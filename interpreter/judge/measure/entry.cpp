// A number on the blackboard after the last tick.
#include "base/core/value.h"
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

// A bool is 1 or 0.
double number_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* flag = std::get_if<bool>(&value);
  return flag != nullptr ? static_cast<double>(*flag) : kNoValue;
}

double number_in(std::string_view text) {
  if (text == "true" || text == "false") return text == "true" ? 1 : 0;
  return parse_double(text).value_or(kNoValue);
}

class EntryAtEnd final : public Accumulator {
 public:
  explicit EntryAtEnd(const MeasureTarget& target) : entry_(target.entry) {}
  void reset() override { number_ = kNoValue; }
  void after_tick(const TickView& view) override {
    const Moment& moment = *view.moment;
    if (moment.texts.empty()) {
      number_ = number_of(moment.entries[entry_].value());
    } else {
      const auto& text = moment.texts[entry_].text;
      number_ = text ? number_in(*text) : kNoValue;
    }
  }
  double value(const EndView&) const override {
    return std::isfinite(number_) ? number_ : kNoValue;
  }

 private:
  std::size_t entry_;
  double number_ = kNoValue;
};

}  // namespace

extern const Measure kEntry{
    .name = "entry",
    .argument = ":KEY",
    .of = MeasureOf::Entry,
    .axis = "entry",
    .doc = "the number in the blackboard entry KEY after the last tick; 1 or 0 for a bool",
    .make = make_accumulator<EntryAtEnd>,
    .is_possible = [](double value, const MeasureSpec&,
                      const MeasuredRun&) { return std::isfinite(value); },
    .label = [](const MeasureSpec& spec) { return spec.name; }};

}  // namespace lockstep::host
