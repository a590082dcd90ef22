// Values as bytes, and back. What has fields lists them once, in a function fields(it, value), for
// both. A length is believed only if so much can follow.
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/core/clock.h"

namespace lockstep::host {

// In `fields(auto& it, Is<T> auto& value)`: a T that is read, or a const T that is written.
template <class T, class As>
concept Is = std::same_as<std::remove_const_t<T>, As>;

// Its bytes are the value, and each of them is one.
template <class T>
concept Plain = std::same_as<T, double> || std::is_enum_v<T> ||
    (std::integral<T> && !std::same_as<T, bool>);

class ByteWriter {
 public:
  static constexpr bool kReads = false;
  explicit ByteWriter(std::string& to) : to_(to) {}

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (Plain<T>) {
      to_.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else if constexpr (std::same_as<T, bool>) {
      to_.push_back(static_cast<char>(value));
    } else if constexpr (std::same_as<T, Nanoseconds>) {
      put(std::int64_t{value.count()});
    } else {
      fields(*this, value);
    }
  }
  void put(const std::string& text) { put_items(text); }
  template <class T>
  void put(const std::vector<T>& list) {
    put_items(list);
  }
  template <class List>
  void put_items(const List& list) {
    put(std::uint64_t{list.size()});
    using T = typename List::value_type;
    if constexpr (Plain<T>) {
      if (!list.empty()) {
        to_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
      }
    } else {
      for (const T& it : list) put(it);
    }
  }
  template <class First, class Second>
  void put(const std::pair<First, Second>& pair) {
    put(pair.first);
    put(pair.second);
  }
  template <class Key, class T, class... Rest>
  void put(const std::map<Key, T, Rest...>& map) {
    put_map(map);
  }
  template <class Key, class T>
  void put(const std::unordered_map<Key, T>& map) {
    put_map(map);
  }
  template <class Map>
  void put_map(const Map& map) {
    put(std::uint64_t{map.size()});
    for (const auto& [key, value] : map) {
      put(key);
      put(value);
    }
  }

  std::string& to_;
};

class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view from) : rest_(from) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  void fail() { is_good_ = false; }
  // All that was read was there, and nothing is left.
  bool is_whole() const { return is_good_ && rest_.empty(); }
  bool is_good() const { return is_good_; }
  std::string_view rest() const { return rest_; }

 private:
  bool take(void* to, std::size_t size) {
    if (!is_good_ || size > rest_.size()) {
      is_good_ = false;
      return false;
    }
    if (size != 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }
  template <class T>
  void get(T& value) {
    if constexpr (Plain<T>) {
      take(&value, sizeof value);
    } else if constexpr (std::same_as<T, bool>) {
      std::uint8_t byte = 0;
      take(&byte, 1);
      value = byte != 0;
    } else if constexpr (std::same_as<T, Nanoseconds>) {
      std::int64_t count = 0;
      get(count);
      value = Nanoseconds(count);
    } else {
      fields(*this, value);
    }
  }
  void get(std::string& text) { get_items(text); }
  template <class T>
  void get(std::vector<T>& list) {
    get_items(list);
  }
  template <class List>
  void get_items(List& list) {
    using T = typename List::value_type;
    list.clear();
    const std::size_t size = count(Plain<T> ? sizeof(T) : 1);
    if constexpr (Plain<T>) {
      list.resize(size);
      take(list.data(), size * sizeof(T));
    } else {
      for (std::size_t i = 0; i < size && is_good_; ++i) get(list.emplace_back());
    }
  }
  template <class First, class Second>
  void get(std::pair<First, Second>& pair) {
    get(pair.first);
    get(pair.second);
  }
  template <class Key, class T, class... Rest>
  void get(std::map<Key, T, Rest...>& map) {
    get_map(map);
  }
  template <class Key, class T>
  void get(std::unordered_map<Key, T>& map) {
    get_map(map);
  }
  template <class Map>
  void get_map(Map& map) {
    map.clear();
    const std::size_t size = count(1);
    for (std::size_t i = 0; i < size && is_good_; ++i) {
      typename Map::key_type key{};
      get(key);
      get(map[std::move(key)]);
    }
  }
  // Of items that each need so many bytes at least.
  std::size_t count(std::size_t each) {
    std::uint64_t count = 0;
    get(count);
    if (count <= rest_.size() / each) return static_cast<std::size_t>(count);
    is_good_ = false;
    return 0;
  }

  std::string_view rest_;
  bool is_good_ = true;
};

}  // namespace lockstep::host
