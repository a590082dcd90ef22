// The five types that a port may have, each with its functions of the host. Included by
// cpp/port.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "caller.hpp"
#include "text.hpp"

namespace lockstep {
inline namespace sdk1 {

// Numbers that belong to the host: a list port, read without a copy.
class ListView {
 public:
  constexpr ListView() = default;
  constexpr ListView(const double* data, std::size_t size) : data_(data), size_(size) {}

  constexpr const double* begin() const { return data_; }
  constexpr const double* end() const { return data_ + size_; }
  constexpr const double* data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr double operator[](std::size_t index) const { return data_[index]; }

 private:
  const double* data_ = nullptr;
  std::size_t size_ = 0;
};

namespace detail {

template <class T>
struct PortTraits {
  static_assert(sizeof(T) == 0,
                "a port is of type bool, std::int64_t, double, std::string or std::vector<double>");
};

template <>
struct PortTraits<bool> {
  using View = bool;
  static constexpr lockstep_type kType = LOCKSTEP_BOOL;
  static constexpr bool accepts(std::string_view text) { return is_bool(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    return caller.host->get_bool(caller.id, port, &value);
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return caller.host->set_bool(caller.id, port, value);
  }
};

template <>
struct PortTraits<std::int64_t> {
  using View = std::int64_t;
  static constexpr lockstep_type kType = LOCKSTEP_INT;
  static constexpr bool accepts(std::string_view text) { return is_int(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    return caller.host->get_int(caller.id, port, &value);
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return caller.host->set_int(caller.id, port, value);
  }
};

template <>
struct PortTraits<double> {
  using View = double;
  static constexpr lockstep_type kType = LOCKSTEP_DOUBLE;
  static constexpr bool accepts(std::string_view text) { return is_double(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    return caller.host->get_double(caller.id, port, &value);
  }
  static bool set(const Caller& caller, std::uint32_t port, View value) {
    return caller.host->set_double(caller.id, port, value);
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

template <>
struct PortTraits<std::vector<double>> {
  using View = ListView;
  static constexpr lockstep_type kType = LOCKSTEP_DOUBLE_LIST;
  static constexpr bool accepts(std::string_view text) { return is_double_list(text); }
  static bool get(const Caller& caller, std::uint32_t port, View& value) {
    const double* data = nullptr;
    std::size_t size = 0;
    if (!caller.host->get_double_list(caller.id, port, &data, &size)) return false;
    value = View(data, size);
    return true;
  }
  static bool set(const Caller& caller, std::uint32_t port, const std::vector<double>& value) {
    return caller.host->set_double_list(caller.id, port, value.data(), value.size());
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
template <class T>
std::vector<double> from_view(ListView value) {
  return std::vector<double>(value.begin(), value.end());
}

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
