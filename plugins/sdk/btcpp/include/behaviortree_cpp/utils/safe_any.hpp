// A value of any type. Inside, integers and enums are 64 bits wide, real numbers double, texts
// std::string; all else is held as it is. What is read as another type is checked.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <variant>

#include "behaviortree_cpp/contrib/expected.hpp"
#include "behaviortree_cpp/exceptions.h"
#include "behaviortree_cpp/utils/demangle_util.h"

namespace BT {

class PolymorphicCastRegistry;

namespace lockstep_detail {

struct Place;
struct EntryValue;
// An object as a value of an entry; lockstep/entry_value.h has it.
template <class T>
void describe_object(const std::shared_ptr<void>& value, EntryValue& described);
// An object into a port of any type; lockstep/port_value.h has it.
template <class T>
bool store_object(const Place& place, std::uint32_t port, const void* value);

template <class T>
inline constexpr bool is_text_v =
    std::is_same_v<T, std::string> || std::is_same_v<T, std::string_view> ||
    std::is_same_v<T, const char*> || std::is_same_v<T, char*>;

template <class T>
inline constexpr bool is_shared_pointer_v = false;
template <class T>
inline constexpr bool is_shared_pointer_v<std::shared_ptr<T>> = true;

// A number as one of another type; false: it is not exactly one.
template <class To, class From>
bool convert_number(From from, To& to) {
  if constexpr (std::is_same_v<To, bool>) {
    if constexpr (std::is_floating_point_v<From>) {
      if (from < 0) return false;
    } else {
      if (from != 0 && from != 1) return false;
    }
    to = from != 0;
    return true;
  } else if constexpr (std::is_floating_point_v<To>) {
    to = static_cast<To>(from);
    if constexpr (std::is_integral_v<From>) {
      constexpr From kExact = From{1} << 53;
      if (from >= kExact) return false;
      if constexpr (std::is_signed_v<From>) return from > -kExact;
    }
    return true;
  } else if constexpr (std::is_floating_point_v<From>) {
    constexpr double kEnd = 9223372036854775808.0;
    if (!(from >= -kEnd && from < kEnd) || from != std::trunc(from)) return false;
    return convert_number(static_cast<std::int64_t>(from), to);
  } else {
    to = static_cast<To>(from);
    return static_cast<From>(to) == from && (to < To{}) == (from < From{});
  }
}

}  // namespace lockstep_detail

class Any {
 public:
  Any() = default;
  Any(const std::type_index& type) : type_(type) {}  // NOLINT: as in the library
  template <class T, class = std::enable_if_t<!std::is_same_v<std::decay_t<T>, Any>>>
  explicit Any(const T& value) : type_(typeid(std::decay_t<const T>)) {
    using Value = std::decay_t<const T>;
    if constexpr (lockstep_detail::is_text_v<Value>) {
      it_ = std::string(value);
      type_ = typeid(std::string);
    } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
      it_ = value;
    } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
      it_ = static_cast<std::int64_t>(value);
    } else if constexpr (std::is_floating_point_v<Value>) {
      it_ = static_cast<double>(value);
    } else {
      it_ = Object{std::make_shared<Value>(value), &kOperations<Value>};
    }
  }

  bool empty() const { return it_.index() == 0; }
  bool isNumber() const { return isIntegral() || std::holds_alternative<double>(it_); }
  bool isIntegral() const {
    return std::holds_alternative<std::int64_t>(it_) || std::holds_alternative<std::uint64_t>(it_);
  }
  bool isString() const { return std::holds_alternative<std::string>(it_); }
  template <class T>
  bool isType() const {
    return type_ == typeid(T);
  }
  // The type that it was made from.
  std::type_index type() const { return type_; }
  // The type that it has inside.
  const std::type_info& castedType() const {
    if (empty()) return typeid(void);
    if (isString()) return typeid(std::string);
    if (std::holds_alternative<double>(it_)) return typeid(double);
    if (std::holds_alternative<std::int64_t>(it_)) return typeid(std::int64_t);
    if (std::holds_alternative<std::uint64_t>(it_)) return typeid(std::uint64_t);
    return std::get<Object>(it_).ops->type;
  }

  template <class T>
  nonstd::expected<T, std::string> tryCast() const {
    static_assert(!std::is_reference_v<T>, "Any::cast gives a value, not a reference");
    if constexpr (std::is_same_v<T, Any>) {
      return *this;
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (const auto* text = std::get_if<std::string>(&it_)) return *text;
      if (isNumber()) return number_text();
    } else if constexpr (std::is_enum_v<T>) {
      if (int number = 0; to_number(number)) return static_cast<T>(number);
      if (std::int64_t number = 0; text_to_number(number)) return static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      if (T number{}; to_number(number) || text_to_number(number)) return number;
      if (isNumber()) {
        return nonstd::make_unexpected(StrCat(number_text(), " has no exact value of type ",
                                              lockstep_detail::readable(typeid(T))));
      }
    } else if (const T* object = find<T>()) {
      return *object;
    }
    return nonstd::make_unexpected(
        empty() ? std::string("the value is empty")
                : StrCat("a value of type ", lockstep_detail::readable(type_), " is none of type ",
                         lockstep_detail::readable(typeid(T))));
  }

  // The same; of a std::shared_ptr also one to a base or a derived class that is registered.
  template <class T>
  nonstd::expected<T, std::string> tryCastWithRegistry(
      const PolymorphicCastRegistry& registry) const;

  template <class T>
  T cast() const {
    auto value = tryCast<T>();
    if (!value) throw std::runtime_error(StrCat("Any::cast: ", value.error()));
    return std::move(*value);
  }

  // The value inside, to be changed; null when it has another type there.
  template <class T>
  T* castPtr() {
    static_assert(!std::is_same_v<T, float>, "inside it is a double: castPtr<double>()");
    if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, double> ||
                  std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t>) {
      return std::get_if<T>(&it_);
    } else {
      static_assert(!std::is_arithmetic_v<T>, "inside it is 64 bits wide: castPtr<int64_t>()");
      auto* const object = std::get_if<Object>(&it_);
      if (object == nullptr || find<T>() == nullptr) return nullptr;
      if (object->value.use_count() > 1) object->value = object->ops->clone(object->value.get());
      return static_cast<T*>(object->value.get());
    }
  }
  template <class T>
  const T* castPtr() const {
    return const_cast<Any*>(this)->castPtr<T>();  // NOLINT: it is not changed
  }

  // The object inside; null: it is a number, a text or empty.
  const void* lockstep_object() const {
    const auto* const object = std::get_if<Object>(&it_);
    return object == nullptr ? nullptr : object->value.get();
  }
  // For ports of any type: false when it is no object, or the port does not take it.
  bool lockstep_store_object(const lockstep_detail::Place& place, std::uint32_t port) const {
    const auto* const object = std::get_if<Object>(&it_);
    return object != nullptr && object->ops->store(place, port, object->value.get());
  }

  // For entries: false when it is no object.
  bool lockstep_describe(lockstep_detail::EntryValue& described) const {
    const auto* const object = std::get_if<Object>(&it_);
    if (object != nullptr) object->ops->describe(object->value, described);
    return object != nullptr;
  }
  // An object that is not copied: it has other owners.
  template <class T>
  static Any lockstep_share(std::shared_ptr<T> value) {
    Any any;
    any.type_ = typeid(T);
    any.it_ = Object{std::move(value), &kOperations<T>};
    return any;
  }

  // The value as one of the type that `other` has. Throws when it is none.
  void copyInto(Any& other) const {
    if (other.empty() || castedType() == other.castedType()) {
      other.it_ = it_;
      if (other.type_ == typeid(std::nullptr_t)) other.type_ = type_;
      return;
    }
    if (isNumber() && other.isNumber() &&
        std::visit([this](auto& number) { return to_held(number); }, other.it_)) {
      return;
    }
    if (isNumber() && other.isString()) {
      other.it_ = number_text();
      return;
    }
    throw std::runtime_error(StrCat("Any::copyInto: a value of type ",
                                    lockstep_detail::readable(type_), " is none of type ",
                                    lockstep_detail::readable(other.type_)));
  }

 private:
  struct Operations {
    const std::type_info& type;
    std::shared_ptr<void> (*clone)(const void*);
    bool (*store)(const lockstep_detail::Place& place, std::uint32_t port, const void* value);
    void (*describe)(const std::shared_ptr<void>& value, lockstep_detail::EntryValue& described);
  };
  template <class T>
  static std::shared_ptr<void> clone(const void* value) {
    return std::make_shared<T>(*static_cast<const T*>(value));
  }
  template <class T>
  inline static const Operations kOperations{typeid(T), clone<T>, lockstep_detail::store_object<T>,
                                             lockstep_detail::describe_object<T>};

  struct Object {
    std::shared_ptr<void> value;
    const Operations* ops;
  };

  template <class T>
  const T* find() const {
    const auto* const object = std::get_if<Object>(&it_);
    if (object == nullptr || object->ops->type != typeid(T)) return nullptr;
    return static_cast<const T*>(object->value.get());
  }

  template <class T>
  bool to_number(T& number) const {
    if (const auto* whole = std::get_if<std::int64_t>(&it_)) {
      return lockstep_detail::convert_number(*whole, number);
    }
    if (const auto* whole = std::get_if<std::uint64_t>(&it_)) {
      return lockstep_detail::convert_number(*whole, number);
    }
    const auto* const real = std::get_if<double>(&it_);
    return real != nullptr && lockstep_detail::convert_number(*real, number);
  }
  // What a text begins with.
  template <class T>
  bool text_to_number([[maybe_unused]] T& number) const {
    if constexpr (!std::is_same_v<T, bool>) {
      const auto* const text = std::get_if<std::string>(&it_);
      if (text == nullptr) return false;
      return std::from_chars(text->data(), text->data() + text->size(), number).ec == std::errc();
    }
    return false;
  }
  template <class T>
  bool to_held(T& held) const {
    if constexpr (std::is_arithmetic_v<T>) {
      return to_number(held);
    } else {
      return false;
    }
  }

  std::string number_text() const {
    if (const auto* whole = std::get_if<std::int64_t>(&it_)) return std::to_string(*whole);
    if (const auto* whole = std::get_if<std::uint64_t>(&it_)) return std::to_string(*whole);
    return std::to_string(std::get<double>(it_));
  }

  std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string, Object> it_;
  std::type_index type_{typeid(std::nullptr_t)};
};

}  // namespace BT
