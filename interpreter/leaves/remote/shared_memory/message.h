// Messages between a host and a leafhost, as bytes. Both are from one build on one machine, so
// numbers are copied as they are in memory. A reader checks everything: a plugin may have written
// anything.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/core/value.h"
#include "leaves/plugin/contract/packed_object.h"

namespace lockstep::host {

// A message that is smaller is not worth two looks at the clock: bytes.
inline constexpr std::size_t kMuchToCarry = std::size_t{64} << 10;

class MessageWriter {
 public:
  void clear() { bytes_.clear(); }
  template <class T>
  void put(T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  void put_text(std::string_view text);
  // A text that may be absent, as in the descriptors.
  void put_text_or_null(const char* text);
  // An object must be packed.
  void put_value(const Value& value);
  void append(const void* data, std::size_t size);
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;  // keeps its capacity
};

// After an error, everything that is read is empty and good() is false.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
    T value{};
    if (const std::byte* data = take(sizeof value)) std::memcpy(&value, data, sizeof value);
    return value;
  }
  std::string_view text();
  bool has_text();  // what put_text_or_null wrote before the text
  // Reads into `value` and reuses its memory. Returns false if it is not a value of any type.
  // Objects are made to be of `objects`; null: there are none.
  bool value_into(Value& value, const PackedType* objects = nullptr);
  const std::byte* take(std::size_t size);  // null: there are not so many
  std::span<const std::byte> rest() const { return rest_; }
  bool good() const { return good_; }

 private:
  bool fail();

  std::span<const std::byte> rest_;
  bool good_ = true;
};

}  // namespace lockstep::host
