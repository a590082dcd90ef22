#include "leaves/plugin/contract/entry_value.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/core/value_types.h"
#include "base/core/wording.h"
#include "leaves/plugin/contract/object_type.h"

namespace lockstep::host {
namespace {

static_assert(sizeof(Flag) == sizeof(bool));

// Describes a value as the contract does. The texts of a list are put together in `texts`.
struct Describer {
  lockstep_entry_value& value;
  std::vector<lockstep_text>& texts;

  void operator()(const NoValue& /*none*/) const {}
  void operator()(bool flag) const { value.flag = flag; }
  void operator()(std::int64_t whole) const { value.whole = whole; }
  void operator()(double number) const { value.number = number; }
  void operator()(const std::string& text) const { point_to(text.c_str(), text.size()); }
  template <class T>
  void operator()(const std::vector<T>& list) const {
    point_to(list.data(), list.size());
  }
  void operator()(const std::vector<std::string>& list) const {
    texts.clear();
    for (const std::string& text : list) texts.push_back({text.c_str(), text.size()});
    point_to(texts.data(), texts.size());
  }
  void operator()(const Object& object) const {
    value.object_name = object.type()->name().data();
    if (object.type()->is_packed()) {
      value.type = 0;
    } else {
      value.object = object.get();
    }
  }

 private:
  void point_to(const void* items, std::size_t count) const {
    value.items = items;
    value.count = count;
  }
};

// The other way: one overload for each shape of a value.
class Taker {
 public:
  Taker(const lockstep_entry_value& value, const ObjectType* type) : value_(value), type_(type) {}

  bool operator()(std::type_identity<bool>) const { return value_.flag; }
  std::int64_t operator()(std::type_identity<std::int64_t>) const { return value_.whole; }
  double operator()(std::type_identity<double>) const { return value_.number; }
  std::string operator()(std::type_identity<std::string>) const {
    return {static_cast<const char*>(value_.items), value_.count};
  }
  template <class T>
  std::vector<T> operator()(std::type_identity<std::vector<T>>) const {
    const auto* const items = static_cast<const T*>(value_.items);
    return std::vector<T>(items, items + value_.count);
  }
  std::vector<std::string> operator()(std::type_identity<std::vector<std::string>>) const {
    std::vector<std::string> texts;
    const auto* const items = static_cast<const lockstep_text*>(value_.items);
    for (std::size_t i = 0; i < value_.count; ++i) {
      texts.emplace_back(items[i].text, items[i].length);
    }
    return texts;
  }
  NoValue operator()(std::type_identity<NoValue>) const { return {}; }
  Value operator()(std::type_identity<Object>) const {
    if (type_ == nullptr || value_.object == nullptr) return {};
    type_->retain(value_.object);
    return Object(*type_, value_.object);
  }

 private:
  const lockstep_entry_value& value_;
  const ObjectType* type_;
};

// Nothing: it is no value.
std::optional<Value> value_of(const lockstep_entry_value& value, const ObjectType* type) {
  const Taker take(value, type);
  // The types of the contract have the numbers of the alternatives.
  const auto number = static_cast<std::size_t>(value.type);
  Value taken = with_alternative(number, [&](auto of) { return Value(take(of)); });
  if (std::holds_alternative<NoValue>(taken)) return std::nullopt;
  return taken;
}

// Gives the entry its declared type.
void declare(Entry& entry, lockstep_type declared, const ObjectType* object) {
  entry.is_present = true;
  const bool is_any = declared == LOCKSTEP_ANY || declared == 0;
  entry.typing = is_any ? Typing::Any : Typing::Declared;
  entry.type = is_any ? ValueType::String : static_cast<ValueType>(declared);
  entry.object = is_any ? nullptr : object;
}

}  // namespace

lockstep_entry_value described(const Entry& entry, std::vector<lockstep_text>& texts) {
  lockstep_entry_value value{};
  value.declared = entry.typing == Typing::Any       ? LOCKSTEP_ANY
                   : entry.type == ValueType::Number ? LOCKSTEP_NUMBER
                                                     : static_cast<lockstep_type>(entry.type);
  if (entry.object != nullptr) value.object_name = entry.object->name().data();
  // The types of the contract have the numbers of the alternatives.
  value.type = static_cast<lockstep_type>(entry.value().index());
  std::visit(Describer{value, texts}, entry.value());
  return value;
}

bool assign(Entry& entry, const lockstep_entry_value& given) {
  const ObjectType* type = nullptr;
  if (given.object_type != nullptr) {
    const auto known = read_object_type(given.object_type, "");
    if (!known) return false;
    type = *known;
  }
  std::optional<Value> value = value_of(given, type);
  if (given.type != 0 && !value) return false;
  if (entry.typing == Typing::Strict) {
    if (!value || !holds(*value, entry.type)) return false;
  } else {
    declare(entry, given.declared, type);
  }
  if (value) entry.assign(*std::move(value));
  return true;
}

std::string refusal_of(const Entry& entry, std::string_view key, ValueType type) {
  const std::string name = fmt::format("the entry '{{{}}}'", brief(key));
  if (entry.type != ValueType::String && std::holds_alternative<std::int64_t>(entry.value())) {
    return name + " has whole numbers only";
  }
  if (entry.type == type) return name + " has real numbers, of which none is exactly this one";
  return fmt::format("{} has the type {}, the port the type {}", name, to_string(entry.type),
                     to_string(type));
}

}  // namespace lockstep::host
