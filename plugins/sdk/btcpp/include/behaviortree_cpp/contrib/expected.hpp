// A value, or why there is none: the part of nonstd::expected that leaves use.
#pragma once

#include <exception>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace nonstd {

template <class Error>
class unexpected_type {
 public:
  explicit unexpected_type(Error error) : error_(std::move(error)) {}
  const Error& error() const& { return error_; }
  Error&& error() && { return std::move(error_); }

 private:
  Error error_;
};

template <class Error>
unexpected_type<std::decay_t<Error>> make_unexpected(Error&& error) {
  return unexpected_type<std::decay_t<Error>>(std::forward<Error>(error));
}

// Thrown by value() when there is none. Its text is the error, if that is a text.
template <class Error>
class bad_expected_access : public std::exception {
 public:
  explicit bad_expected_access(Error error) : error_(std::move(error)) {}
  const Error& error() const { return error_; }
  const char* what() const noexcept override {
    if constexpr (std::is_same_v<Error, std::string>) {
      return error_.c_str();
    } else {
      return "there is no value";
    }
  }

 private:
  Error error_;
};

template <class T, class Error>
class expected {
 public:
  using value_type = T;
  using error_type = Error;

  expected() = default;
  template <class U = T,
            class = std::enable_if_t<
                std::is_constructible_v<T, U&&> && !std::is_same_v<std::decay_t<U>, expected> &&
                (std::is_convertible_v<U&&, T> || !std::is_class_v<std::decay_t<U>>)>>
  expected(U&& value)  // NOLINT: a value is an expected
      : it_(std::in_place_index<0>, std::forward<U>(value)) {}
  template <class Other, class = std::enable_if_t<std::is_constructible_v<Error, Other>>>
  expected(unexpected_type<Other> error)  // NOLINT: so is an error
      : it_(std::in_place_index<1>, Error(std::move(error).error())) {}

  bool has_value() const noexcept { return it_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  T& value() & { return checked(), std::get<0>(it_); }
  const T& value() const& { return checked(), std::get<0>(it_); }
  T&& value() && { return checked(), std::get<0>(std::move(it_)); }
  T& operator*() & { return *std::get_if<0>(&it_); }
  const T& operator*() const& { return *std::get_if<0>(&it_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&it_)); }
  T* operator->() { return std::get_if<0>(&it_); }
  const T* operator->() const { return std::get_if<0>(&it_); }

  const Error& error() const& { return std::get<1>(it_); }
  Error& error() & { return std::get<1>(it_); }

  template <class U>
  T value_or(U&& otherwise) const& {
    return has_value() ? **this : static_cast<T>(std::forward<U>(otherwise));
  }
  template <class U>
  T value_or(U&& otherwise) && {
    return has_value() ? std::move(**this) : static_cast<T>(std::forward<U>(otherwise));
  }

 private:
  void checked() const {
    if (!has_value()) throw bad_expected_access<Error>(std::get<1>(it_));
  }

  std::variant<T, Error> it_;
};

// Equal: both have equal values, or both have equal errors; a value is equal to one that is there.
template <class T, class U, class Error>
constexpr bool operator==(const expected<T, Error>& a, const expected<U, Error>& b) {
  if (a.has_value() != b.has_value()) return false;
  return a.has_value() ? *a == *b : a.error() == b.error();
}
template <class T, class U, class Error>
constexpr bool operator!=(const expected<T, Error>& a, const expected<U, Error>& b) {
  return !(a == b);
}
template <class T, class Error, class U,
          class = decltype(static_cast<bool>(std::declval<const T&>() == std::declval<const U&>()))>
constexpr bool operator==(const expected<T, Error>& a, const U& value) {
  return a.has_value() && *a == value;
}
template <class T, class Error, class U,
          class = decltype(static_cast<bool>(std::declval<const T&>() == std::declval<const U&>()))>
constexpr bool operator==(const U& value, const expected<T, Error>& a) {
  return a == value;
}
template <class T, class Error, class U,
          class = decltype(static_cast<bool>(std::declval<const T&>() == std::declval<const U&>()))>
constexpr bool operator!=(const expected<T, Error>& a, const U& value) {
  return !(a == value);
}
template <class T, class Error, class U,
          class = decltype(static_cast<bool>(std::declval<const T&>() == std::declval<const U&>()))>
constexpr bool operator!=(const U& value, const expected<T, Error>& a) {
  return !(a == value);
}
template <class T, class Error, class Other>
constexpr bool operator==(const expected<T, Error>& a, const unexpected_type<Other>& error) {
  return !a.has_value() && a.error() == error.error();
}
template <class T, class Error, class Other>
constexpr bool operator!=(const expected<T, Error>& a, const unexpected_type<Other>& error) {
  return !(a == error);
}

// Success, or why there is none.
template <class Error>
class expected<void, Error> {
 public:
  expected() = default;
  template <class Other>
  expected(unexpected_type<Other> error)  // NOLINT: an error is an expected
      : error_(std::move(error).error()), has_value_(false) {}

  bool has_value() const noexcept { return has_value_; }
  explicit operator bool() const noexcept { return has_value_; }
  void value() const {
    if (!has_value_) throw bad_expected_access<Error>(error_);
  }
  const Error& error() const { return error_; }

 private:
  Error error_{};
  bool has_value_ = true;
};

}  // namespace nonstd
