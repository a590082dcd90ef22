// A value of any type. Inside, integers and enums are 64 bits wide, real numbers double, texts
// std::string; all else is held as it is. What is read as another type is checked.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>

#include "behaviortree_cpp/contrib/expected.hpp"
#include "behaviortree_cpp/exceptions.h"
#include "behaviortree_cpp/lockstep/inline.h"
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
    to = static_cast<To>(from);  // NOLINT(bugprone-signed-char-misuse)
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
    to = static_cast<To>(from);  // NOLINT(bugprone-signed-char-misuse)
    return static_cast<From>(to) == from && (to < To{}) == (from < From{});
  }
}

}  // namespace lockstep_detail

class Any {
  enum class LockstepKind : std::uint8_t { kNone, kWhole, kUnsigned, kReal, kText, kObject };
  using Kind = LockstepKind;

 public:
  Any() {}                                           // NOLINT: a union has no default
  Any(const std::type_index& type) : type_(type) {}  // NOLINT: as in the library
  template <class T, class = std::enable_if_t<!std::is_same_v<std::decay_t<T>, Any>>>
  explicit Any(const T& value) : type_(typeid(std::decay_t<const T>)) {
    using Value = std::decay_t<const T>;
    if constexpr (lockstep_detail::is_text_v<Value>) {
      hold(std::string(value));
      type_ = typeid(std::string);
    } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
      unsigned_ = value;
      kind_ = Kind::kUnsigned;
    } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
      whole_ = static_cast<std::int64_t>(value);  // NOLINT(bugprone-signed-char-misuse)
      kind_ = Kind::kWhole;
    } else if constexpr (std::is_floating_point_v<Value>) {
      real_ = static_cast<double>(value);
      kind_ = Kind::kReal;
    } else {
      hold(std::make_shared<Value>(value), kOperations<Value>);
    }
  }
  Any(const Any& other) : type_(other.type_) { hold_copy(other); }
  Any(Any&& other) noexcept : type_(other.type_) { hold_moved(other); }
  Any& operator=(const Any& other) {
    if (this != &other) *this = Any(other);
    return *this;
  }
  Any& operator=(Any&& other) noexcept {
    if (this == &other) return *this;
    drop();
    type_ = other.type_;
    hold_moved(other);
    return *this;
  }
  ~Any() { drop(); }

  bool empty() const { return kind_ == Kind::kNone; }
  bool isNumber() const { return isIntegral() || kind_ == Kind::kReal; }
  bool isIntegral() const { return kind_ == Kind::kWhole || kind_ == Kind::kUnsigned; }
  bool isString() const { return kind_ == Kind::kText; }
  template <class T>
  bool isType() const {
    return type_ == typeid(T);
  }
  // The type that it was made from.
  std::type_index type() const { return type_; }
  // The type that it has inside.
  const std::type_info& castedType() const;

  template <class T>
  nonstd::expected<T, std::string> tryCast() const {
    static_assert(!std::is_reference_v<T>, "Any::cast gives a value, not a reference");
    if constexpr (std::is_same_v<T, Any>) {
      return *this;
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (isString()) return text_;
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
      return find_held(static_cast<T*>(nullptr));
    } else {
      static_assert(!std::is_arithmetic_v<T>, "inside it is 64 bits wide: castPtr<int64_t>()");
      if (find<T>() == nullptr) return nullptr;
      if (object_.value.use_count() > 1) object_.value = object_.ops->clone(object_.value.get());
      return static_cast<T*>(object_.value.get());
    }
  }
  template <class T>
  const T* castPtr() const {
    return const_cast<Any*>(this)->castPtr<T>();  // NOLINT: it is not changed
  }

  // The object inside; null: it is a number, a text or empty.
  const void* lockstep_object() const {
    return kind_ == Kind::kObject ? object_.value.get() : nullptr;
  }
  // For ports of any type: false when it is no object, or the port does not take it.
  bool lockstep_store_object(const lockstep_detail::Place& place, std::uint32_t port) const {
    return kind_ == Kind::kObject && object_.ops->store(place, port, object_.value.get());
  }

  // For entries: false when it is no object.
  bool lockstep_describe(lockstep_detail::EntryValue& described) const {
    if (kind_ == Kind::kObject) object_.ops->describe(object_.value, described);
    return kind_ == Kind::kObject;
  }
  // An object that is not copied: it has other owners.
  template <class T>
  static Any lockstep_share(std::shared_ptr<T> value) {
    Any any;
    any.type_ = typeid(T);
    any.hold(std::move(value), kOperations<T>);
    return any;
  }

  // The value as one of the type that `other` has. Throws when it is none.
  void copyInto(Any& other) const;

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
    if (kind_ != Kind::kObject || object_.ops->type != typeid(T)) return nullptr;
    return static_cast<const T*>(object_.value.get());
  }
  std::string* find_held(std::string* /*type*/) { return isString() ? &text_ : nullptr; }
  double* find_held(double* /*type*/) { return kind_ == Kind::kReal ? &real_ : nullptr; }
  std::int64_t* find_held(std::int64_t* /*type*/) {
    return kind_ == Kind::kWhole ? &whole_ : nullptr;
  }
  std::uint64_t* find_held(std::uint64_t* /*type*/) {
    return kind_ == Kind::kUnsigned ? &unsigned_ : nullptr;
  }

  template <class T>
  bool to_number(T& number) const {
    switch (kind_) {
      case Kind::kWhole:
        return lockstep_detail::convert_number(whole_, number);
      case Kind::kUnsigned:
        return lockstep_detail::convert_number(unsigned_, number);
      case Kind::kReal:
        return lockstep_detail::convert_number(real_, number);
      default:
        return false;
    }
  }
  // The number that a text begins with.
  template <class T>
  bool text_to_number([[maybe_unused]] T& number) const {
    if constexpr (!std::is_same_v<T, bool>) {
      if (!isString()) return false;
      return std::from_chars(text_.data(), text_.data() + text_.size(), number).ec == std::errc();
    }
    return false;
  }
  std::string number_text() const;

  // For an Any that holds nothing.
  void hold(std::string text);
  void hold(std::shared_ptr<void> object, const Operations& ops);
  void hold_copy(const Any& other) {
    if (other.kind_ >= Kind::kText) return hold_owned(other);
    hold_number(other);
  }
  void hold_moved(Any& other) noexcept {
    if (other.kind_ >= Kind::kText) return hold_owned(std::move(other));
    hold_number(other);
  }
  void hold_number(const Any& other) {  // or nothing
    std::memcpy(&whole_, &other.whole_, sizeof whole_);
    kind_ = other.kind_;
  }
  void hold_owned(const Any& other);
  void hold_owned(Any&& other) noexcept;
  void drop() noexcept {
    if (kind_ >= Kind::kText) destroy();
    kind_ = Kind::kNone;
  }
  void destroy() noexcept;

  // No std::variant: to copy and to end one would be compiled in each source.
  union {
    std::int64_t whole_ = 0;
    std::uint64_t unsigned_;
    double real_;
    std::string text_;
    Object object_;
  };
  std::type_index type_{typeid(std::nullptr_t)};
  Kind kind_ = Kind::kNone;
};

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/safe_any.h"  // IWYU pragma: export
#endif
