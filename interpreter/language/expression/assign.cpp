#include "language/expression/assign.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/parameter_value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// The value that an entry gets, or nothing: it does not take the operand.
class Assigned {
 public:
  Assigned(const Entry& entry, const ScriptEnums* enums) : entry_(entry), enums_(enums) {}

  std::optional<Value> of(const Operand& operand) const {
    const bool is_text = operand.kind == Operand::Kind::Text;
    if (is_text && !std::holds_alternative<std::string>(entry_.value())) return of_text(operand);
    if (!entry_.has_value()) return into_empty(operand);
    return same_kind(operand);
  }

 private:
  bool is_typed() const { return entry_.typing != Typing::Any; }

  // Into an entry that has no text.
  std::optional<Value> of_text(const Operand& operand) const {
    if (is_typed()) return convert_value(*operand.text, entry_.type, entry_.object);
    if (!entry_.has_value()) return operand.value();
    if (!Operand::of(entry_.value()).is_number()) return std::nullopt;
    const auto number = number_in_script(*operand.text, enums_);
    return number ? std::optional<Value>(*number) : std::nullopt;
  }

  std::optional<Value> into_empty(const Operand& operand) const {
    // A port declares what it reads the value as; until one writes it, the entry is what it holds.
    if (entry_.typing != Typing::Strict) return operand.value();
    const bool is_text = entry_.type == ValueType::String && operand.is_number();
    if (is_text) return std::nullopt;
    return cast_value(operand.value(), entry_.type, entry_.object);
  }

  std::optional<Value> same_kind(const Operand& operand) const {
    switch (Operand::of(entry_.value()).kind) {
      case Operand::Kind::Whole:
        return as_whole(operand);
      case Operand::Kind::Real:
        return operand.is_number() ? cast_value(operand.value(), ValueType::Double, nullptr)
                                   : std::nullopt;
      case Operand::Kind::Text:
        return operand.kind == Operand::Kind::Text ? std::optional(operand.value()) : std::nullopt;
      case Operand::Kind::Other:
        return as_other(operand);
      case Operand::Kind::Empty:
        break;
    }
    return std::nullopt;
  }

  std::optional<Value> as_whole(const Operand& operand) const {
    if (!operand.is_number()) return std::nullopt;
    const auto whole = cast_value(operand.value(), ValueType::Int, nullptr);
    if (!whole) return may_become_real() ? std::optional(operand.value()) : std::nullopt;
    // true and false stay what they are, as long as the number is one of them.
    if (!std::holds_alternative<bool>(entry_.value())) return whole;
    auto flag = cast_value(*whole, ValueType::Bool, nullptr);
    return flag ? flag : whole;
  }

  bool may_become_real() const { return is_typed() && entry_.type == ValueType::Number; }

  std::optional<Value> as_other(const Operand& operand) const {
    if (operand.kind != Operand::Kind::Other) return std::nullopt;
    if (operand.other->index() != entry_.value().index()) return std::nullopt;
    const auto* held = std::get_if<Object>(&entry_.value());
    return cast_value(operand.value(), static_cast<ValueType>(entry_.value().index()),
                      held == nullptr ? nullptr : held->type());
  }

  const Entry& entry_;
  const ScriptEnums* enums_;
};

bool is_allowed(const Entry& entry, const Value& value) {
  if (entry.typing != Typing::Strict) return true;
  const auto* real = std::get_if<double>(&value);
  return holds(value, entry.type) && (real == nullptr || std::isfinite(*real));
}

}  // namespace

std::optional<double> number_in_script(std::string_view text, const ScriptEnums* enums) {
  if (text == "true") return 1;
  if (text == "false") return 0;
  if (enums != nullptr) {
    const auto word = enums->find(text);
    if (word != enums->end()) return word->second;
  }
  if (const auto flag = parse_flag(text)) return *flag ? 1 : 0;
  const auto number = number_from_text(text);
  return number ? std::optional(number->value) : std::nullopt;
}

bool assign_number(Entry& entry, const Operand& value) {
  if (std::holds_alternative<double>(entry.value())) {
    const bool is_real = value.kind == Operand::Kind::Real && std::isfinite(value.real);
    const bool is_whole = value.kind == Operand::Kind::Whole && to_real(value.whole);
    if (!is_real && !is_whole) return false;
    entry.assign_same(is_real ? value.real : static_cast<double>(value.whole));
  } else {
    if (!std::holds_alternative<std::int64_t>(entry.value()) || !value.is_number()) return false;
    const auto exact = value.kind == Operand::Kind::Real ? to_whole(value.real) : value.whole;
    if (!exact) return false;
    entry.assign_same(*exact);
  }
  return true;
}

bool assign(Entry& entry, const Operand& value, const ScriptEnums* enums) {
  if (assign_number(entry, value)) return true;
  const bool is_text = std::holds_alternative<std::string>(entry.value());
  if (is_text && value.kind == Operand::Kind::Text) {
    *std::get_if<std::string>(&entry.to_write()) = *value.text;  // in the memory that it has
  } else if (value.kind == Operand::Kind::Empty) {
    return false;
  } else {
    auto assigned = Assigned(entry, enums).of(value);
    if (!assigned || !is_allowed(entry, *assigned)) return false;
    entry.assign(std::move(*assigned));
  }
  return true;
}

std::string refusal(const Entry& entry, const Operand& value, std::string_view shown,
                    std::string_view name) {
  std::string what;
  if (value.kind == Operand::Kind::Empty) {
    return fmt::format("cannot assign to '{}': the right side is {}", brief(name), shown);
  }
  if (entry.typing != Typing::Any) {
    what = type_name(entry.type, entry.object);
  } else {
    what = to_string(static_cast<ValueType>(entry.value().index()));
  }
  return fmt::format("cannot assign {} to '{}', which has the type {}", shown, brief(name), what);
}

}  // namespace lockstep::host
