// The types that a port may have, each with its functions of the host. Included by cpp/port.hpp.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../value_types.h"
#include "caller.hpp"
#include "text.hpp"

namespace lockstep {
inline namespace sdk1 {

// Items that belong to the host: a list port, read without a copy.
template <class Item>
class BasicListView {
 public:
  constexpr BasicListView() = default;
  constexpr BasicListView(const Item* data, std::size_t size) : data_(data), size_(size) {}

  constexpr const Item* begin() const { return data_; }
  constexpr const Item* end() const { return data_ + size_; }
  constexpr const Item* data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr Item operator[](std::size_t index) const { return data_[index]; }

 private:
  const Item* data_ = nullptr;
  std::size_t size_ = 0;
};

using ListView = BasicListView<double>;

// The same of strings, whose items are std::string_views.
class StringListView {
 public:
  class Iterator {
   public:
    explicit Iterator(const lockstep_text* item) : item_(item) {}
    std::string_view operator*() const { return {item_->text, item_->length}; }
    Iterator& operator++() {
      ++item_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return item_ != other.item_; }

   private:
    const lockstep_text* item_;
  };

  StringListView() = default;
  StringListView(const lockstep_text* data, std::size_t size) : data_(data), size_(size) {}

  Iterator begin() const { return Iterator(data_); }
  Iterator end() const { return Iterator(data_ + size_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::string_view operator[](std::size_t index) const { return *Iterator(data_ + index); }

 private:
  const lockstep_text* data_ = nullptr;
  std::size_t size_ = 0;
};

// The value that a port reads which takes an int or a double.
class Number {
 public:
  constexpr Number() = default;
  constexpr Number(std::int64_t value) : whole_(value), is_int_(true) {}  // NOLINT: a number
  constexpr Number(double value) : number_(value), is_int_(false) {}      // NOLINT: is a number
  constexpr bool is_int() const { return is_int_; }
  constexpr operator double() const {  // NOLINT: in either case
    return is_int_ ? static_cast<double>(whole_) : number_;
  }
  // Exactly, if it is an int; otherwise without what comes after the point.
  constexpr std::int64_t to_int() const {
    return is_int_ ? whole_ : static_cast<std::int64_t>(number_);
  }

 private:
  std::int64_t whole_ = 0;
  double number_ = 0;
  bool is_int_ = true;
};

// The values that a port takes. Made by the functions of Ports; the host checks them.
struct Limits {
  const char* choices = nullptr;  // of a string, "soft;firm"
  double min = 0, max = 0;        // of numbers; both 0 for any
};

// The names of an enum's values, which LOCKSTEP_CHOICES declares.
template <class Enum>
struct Choices {
  static_assert(sizeof(Enum) == 0, "name the values of the enum with LOCKSTEP_CHOICES");
};

// The name of a type of objects, which LOCKSTEP_OBJECT_TYPE declares.
template <class T>
struct ObjectName {
  static_assert(sizeof(T) == 0, "name the type of the object with LOCKSTEP_OBJECT_TYPE");
};

namespace detail {

template <class T, class = void>
struct PortTraits {
  static_assert(
      sizeof(T) == 0,
      "a port is of type bool, std::int64_t, double, std::string, a std::vector of one of "
      "these, lockstep::Number, an enum, or a std::shared_ptr<const T>");
};

// Numbers, and lists of them.
template <class T>
inline constexpr bool has_numbers = std::is_same_v<T, Number> ||
                                    (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
template <class Item>
inline constexpr bool has_numbers<std::vector<Item>> = has_numbers<Item>;

template <class Item>
constexpr bool is_item(std::string_view text) {
  if constexpr (std::is_same_v<Item, bool>) return is_bool(text);
  return std::is_integral_v<Item> ? is_int(text) : is_double(text);
}

// Values that `kGet` and `kSet` of the host exchange as they are.
template <class T, lockstep_type kOfType, auto kGet, auto kSet>
struct PlainTraits {
  using View = T;
  static constexpr lockstep_type kType = kOfType;
  static constexpr bool accepts(std::string_view text) { return is_item<T>(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    return (caller.host->*kGet)(caller.id, port, &value);
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return (caller.host->*kSet)(caller.id, port, value);
  }
};

#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                     \
  template <>                                                                                 \
  struct PortTraits<Item> : PlainTraits<Item, LOCKSTEP_##TYPE, &lockstep_host::get_##of_type, \
                                        &lockstep_host::set_##of_type> {};
LOCKSTEP_PLAIN_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW

// Only of an input.
template <>
struct PortTraits<Number> {
  using View = Number;
  static constexpr lockstep_type kType = LOCKSTEP_NUMBER;
  static constexpr bool accepts(std::string_view text) { return is_double(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    std::int64_t whole = 0;
    double number = 0;
    if (caller.host->get_int(caller.id, port, &whole)) {
      value = whole;
    } else if (caller.host->get_double(caller.id, port, &number)) {
      value = number;
    } else {
      return false;
    }
    return true;
  }
};

template <>
struct PortTraits<std::string> {
  using View = std::string_view;
  static constexpr lockstep_type kType = LOCKSTEP_STRING;
  static constexpr bool accepts(std::string_view) { return true; }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    const char* text = nullptr;
    std::size_t length = 0;
    if (!caller.host->get_string(caller.id, port, &text, &length)) return false;
    value = View(text, length);
    return true;
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return caller.host->set_string(caller.id, port, value.data(), value.size());
  }
};

// A string that is one of the names of an enum.
template <class Enum>
struct PortTraits<Enum, std::enable_if_t<std::is_enum_v<Enum>>> {
  using View = Enum;
  using Text = PortTraits<std::string>;
  static constexpr lockstep_type kType = LOCKSTEP_STRING;
  static constexpr const char* kWords = Choices<Enum>::kWords;
  static constexpr bool accepts(std::string_view) { return true; }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    std::string_view word;
    if (!Text::get(caller, port, word)) return false;
    const std::size_t index = index_of(word, kWords);
    value = static_cast<Enum>(index);
    return index < count_words(kWords);
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return Text::set(caller, port, word_at(static_cast<std::size_t>(value), kWords));
  }
};

// An object as the host holds it: a std::shared_ptr with a count of its references there.
template <class T>
struct ObjectHolder {
  std::shared_ptr<const T> value;
  std::atomic<std::size_t> references{1};
};

template <class T, class = void>
inline constexpr bool has_to_text = false;
template <class T>
inline constexpr bool
    has_to_text<T, std::void_t<decltype(std::string(to_text(std::declval<const T&>())))>> = true;

template <class T, class = void>
inline constexpr bool has_from_text = false;
template <class T>
inline constexpr bool has_from_text<T, std::void_t<decltype(static_cast<bool>(from_text(
                                           std::string_view(), std::declval<T&>())))>> = true;

template <class T, class = void>
inline constexpr bool has_to_bytes = false;
template <class T>
inline constexpr bool
    has_to_bytes<T, std::void_t<decltype(std::string(to_bytes(std::declval<const T&>())))>> = true;

template <class T, class = void>
inline constexpr bool has_from_bytes = false;
template <class T>
inline constexpr bool has_from_bytes<T, std::void_t<decltype(static_cast<bool>(from_bytes(
                                            std::string_view(), std::declval<T&>())))>> = true;

// The functions of the C table. One that throws gives no text, no bytes or no object.
template <class T>
struct ObjectFunctions {
  using Holder = ObjectHolder<T>;

  static void retain(void* object) { ++static_cast<Holder*>(object)->references; }
  static void release(void* object) {
    Holder* const holder = static_cast<Holder*>(object);
    if (--holder->references == 0) delete holder;
  }
  static std::size_t text_of(const void* object, char* text, std::size_t size) {
    std::size_t length = 0;
    catching(
        [&] {
          const std::string whole(to_text(*static_cast<const Holder*>(object)->value));
          whole.copy(text, size);
          length = whole.size();
        },
        [](const char*) {});
    return length;
  }
  static void* make(const char* text, std::size_t length) {
    return made_by([&](T& value) { return from_text(std::string_view(text, length), value); });
  }
  static std::size_t bytes_of(const void* object, void* bytes, std::size_t size) {
    std::size_t length = SIZE_MAX;
    catching(
        [&] {
          const std::string whole(to_bytes(*static_cast<const Holder*>(object)->value));
          whole.copy(static_cast<char*>(bytes), size);
          length = whole.size();
        },
        [](const char*) {});
    return length;
  }
  static void* unpack(const void* bytes, std::size_t length) {
    const std::string_view whole(static_cast<const char*>(bytes), length);
    return made_by([&](T& value) { return from_bytes(whole, value); });
  }

  template <class Fill>
  static void* made_by(Fill fill) {
    Holder* made = nullptr;
    catching(
        [&] {
          auto value = std::make_shared<T>();
          if (fill(*value)) made = new Holder{std::move(value)};
        },
        [](const char*) {});
    return made;
  }

  static constexpr lockstep_object_type table() {
    lockstep_object_type type{};
    type.struct_size = sizeof(lockstep_object_type);
    type.name = ObjectName<T>::kName;
    type.retain = retain;
    type.release = release;
    if constexpr (has_to_text<T>) type.to_text = text_of;
    if constexpr (has_from_text<T>) type.from_text = make;
    static_assert(has_to_bytes<T> == has_from_bytes<T>,
                  "a type of objects has to_bytes and from_bytes, or neither");
    if constexpr (has_to_bytes<T> && has_from_bytes<T>) {
      type.to_bytes = bytes_of;
      type.from_bytes = unpack;
    }
    return type;
  }
};

template <class T>
inline constexpr lockstep_object_type kObjectTable = ObjectFunctions<T>::table();

template <class T>
struct PortTraits<std::shared_ptr<const T>> {
  using View = std::shared_ptr<const T>;
  static constexpr lockstep_type kType = LOCKSTEP_OBJECT;
  static constexpr const lockstep_object_type* kObject = &kObjectTable<T>;
  static constexpr bool accepts(std::string_view) { return false; }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    void* object = nullptr;
    if (!caller.host->get_object(caller.id, port, &object)) return false;
    value = static_cast<const ObjectHolder<T>*>(object)->value;
    return true;
  }
  static bool set(const Caller& caller, std::uint32_t port, const View& value) {
    if (!value) return false;
    auto* const holder = new ObjectHolder<T>{value};
    const bool is_set = caller.host->set_object(caller.id, port, holder);
    ObjectFunctions<T>::release(holder);
    return is_set;
  }
};

template <class Item, lockstep_type kOfType, auto kGet, auto kSet>
struct ListTraits {
  using View = BasicListView<Item>;
  static constexpr lockstep_type kType = kOfType;
  static constexpr bool accepts(std::string_view text) { return is_list(text, is_item<Item>); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    const Item* data = nullptr;
    std::size_t size = 0;
    if (!(caller.host->*kGet)(caller.id, port, &data, &size)) return false;
    value = View(data, size);
    return true;
  }
  static bool set(const Caller& caller, std::uint32_t port, const std::vector<Item>& value) {
    if constexpr (std::is_same_v<Item, bool>) {
      const std::unique_ptr<bool[]> flags(new bool[value.size()]);  // NOLINT: std::vector has none
      std::copy(value.begin(), value.end(), flags.get());
      return (caller.host->*kSet)(caller.id, port, flags.get(), value.size());
    } else {
      return (caller.host->*kSet)(caller.id, port, value.data(), value.size());
    }
  }
};

// NOLINTBEGIN(bugprone-macro-parentheses): it is a type
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                \
  template <>                                                            \
  struct PortTraits<std::vector<Item>>                                   \
      : ListTraits<Item, LOCKSTEP_##TYPE, &lockstep_host::get_##of_type, \
                   &lockstep_host::set_##of_type> {};
LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
// NOLINTEND(bugprone-macro-parentheses)

template <>
struct PortTraits<std::vector<std::string>> {
  using View = StringListView;
  static constexpr lockstep_type kType = LOCKSTEP_STRING_LIST;
  static constexpr bool accepts(std::string_view) { return true; }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    const lockstep_text* data = nullptr;
    std::size_t size = 0;
    if (!caller.host->get_string_list(caller.id, port, &data, &size)) return false;
    value = View(data, size);
    return true;
  }
  static bool set(const Caller& caller, std::uint32_t port, const std::vector<std::string>& value) {
    std::vector<lockstep_text> texts;
    for (const std::string& text : value) texts.push_back({text.data(), text.size()});
    return caller.host->set_string_list(caller.id, port, texts.data(), texts.size());
  }
};

template <class T>
T from_view(const T& value) {
  return value;
}
template <class T>
std::string from_view(std::string_view value) {
  return std::string(value);
}
template <class T, class Item>
T from_view(BasicListView<Item> value) {
  return T(value.begin(), value.end());
}
template <class T>
T from_view(StringListView value) {
  T texts;
  for (const std::string_view text : value) texts.emplace_back(text);
  return texts;
}

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep

// Names the values of an enum that counts from 0, in order: LOCKSTEP_CHOICES(Grip, "soft;firm"). A
// port may then be of this type. Once, outside of any namespace.
#define LOCKSTEP_CHOICES(Enum, words)                                                    \
  template <>                                                                            \
  struct lockstep::Choices<Enum> {                                                       \
    static_assert(std::is_enum_v<Enum>, "LOCKSTEP_CHOICES names the values of an enum"); \
    static constexpr const char* kWords = words;                                         \
  }

// Declares a type of objects that ports carry as std::shared_ptr<const Type>, with a name for all
// plugins that know it: LOCKSTEP_OBJECT_TYPE(Path, "nav.Path"). Once, outside of any namespace, and
// after those of these functions in the namespace of Type that there are:
//   std::string to_text(const Path&);         // for recordings and views
//   bool from_text(std::string_view, Path&);  // for constants in trees; false: the text is none
//   std::string to_bytes(const Path&);         // both or none: for plugins in separate processes
//   bool from_bytes(std::string_view, Path&);  // false: the bytes are none
#define LOCKSTEP_OBJECT_TYPE(Type, name)       \
  template <>                                  \
  struct lockstep::ObjectName<Type> {          \
    static constexpr const char* kName = name; \
  }
