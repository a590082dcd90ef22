// What an interpreter keeps between two ticks as bytes, and back, by one list of its fields: the
// full state as it is. Only what counts up for ever is kept as far as the law reads it: a moment by
// how long ago it was, a tick by whether it was the last one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>

#include "base/core/clock.h"

namespace lockstep::host::test {

class KeptState {
 public:
  // The moment of the last tick. No duration of the tree is longer than `longest`.
  struct Now {
    Nanoseconds time;
    std::uint32_t tick;
    Nanoseconds longest;
  };
  // Writes to these bytes, or reads them.
  KeptState(std::string& to, const Now& now) : to_(&to), now_(now) {}
  KeptState(const std::string& from, const Now& now) : from_(&from), now_(now) {}

  bool is_writing() const { return to_ != nullptr; }

  template <class... Fields>
  void operator()(Fields&... fields) {
    (field(fields), ...);
  }
  void moment(Nanoseconds& moment) {
    Nanoseconds age = now_.time - moment;
    duration(age);
    moment = now_.time - age;
  }
  // Longer than all of the tree is as long as any other that is.
  void duration(Nanoseconds& duration) {
    duration = std::min(duration, now_.longest + Nanoseconds(1));
    field(duration);
  }
  // 0: never.
  void tick(std::uint32_t& tick) {
    std::uint8_t age =
        static_cast<std::uint8_t>(std::min(tick == 0 ? kOld : now_.tick - tick, kOld));
    field(age);
    tick = age == kOld ? 0 : now_.tick - age;
  }

 private:
  static constexpr std::uint32_t kOld = 3;

  template <class T>
  void field(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    bytes(&value, sizeof value);
  }
  void field(Nanoseconds& value) {
    auto count = value.count();
    field(count);
    value = Nanoseconds(count);
  }
  void field(std::string& text) {
    std::uint32_t size = static_cast<std::uint32_t>(text.size());
    field(size);
    text.resize(size);
    bytes(text.data(), size);
  }
  template <class T>
  void field(std::optional<T>& value) {
    bool has_value = value.has_value();
    field(has_value);
    if (!has_value) return value.reset();
    if (!value) value.emplace();
    field(*value);
  }
  template <class T>
  void field(std::map<std::string, T>& map) {
    std::uint32_t size = static_cast<std::uint32_t>(map.size());
    field(size);
    if (is_writing()) {
      for (auto& [key, value] : map) {
        std::string name = key;
        field(name);
        field(value);
      }
      return;
    }
    map.clear();
    for (; size > 0; --size) {
      std::string name;
      field(name);
      field(map[name]);
    }
  }
  void field(std::set<std::string>& set) {
    std::uint32_t size = static_cast<std::uint32_t>(set.size());
    field(size);
    if (is_writing()) {
      for (std::string name : set) field(name);
      return;
    }
    set.clear();
    for (; size > 0; --size) {
      std::string name;
      field(name);
      set.insert(name);
    }
  }

  void bytes(void* value, std::size_t size) {
    if (is_writing()) {
      to_->append(static_cast<const char*>(value), size);
    } else {
      std::memcpy(value, from_->data() + at_, size);
      at_ += size;
    }
  }

  std::string* to_ = nullptr;
  const std::string* from_ = nullptr;
  std::size_t at_ = 0;
  Now now_;
};

}  // namespace lockstep::host::test
