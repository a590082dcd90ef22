// A value, or why there is none: the part of nonstd::expected that leaves use.
#pragma once

#include <exception>
#include <new>
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

// One of both, alive. No std::variant: each type that it has costs the compiler a tenth of a
// second.
template <class T, class Error>
class lockstep_value_or_error {
 public:
  lockstep_value_or_error(const lockstep_value_or_error& other) : has_value_(other.has_value_) {
    if (has_value_) {
      new (&value_) T(other.value_);
    } else {
      new (&error_) Error(other.error_);
    }
  }
  lockstep_value_or_error(lockstep_value_or_error&& other) noexcept(
      std::is_nothrow_move_constructible_v<T>)
      : has_value_(other.has_value_) {
    if (has_value_) {
      new (&value_) T(std::move(other.value_));
    } else {
      new (&error_) Error(std::move(other.error_));
    }
  }
  lockstep_value_or_error& operator=(const lockstep_value_or_error& other) {
    if (this != &other) take(lockstep_value_or_error(other));
    return *this;
  }
  lockstep_value_or_error& operator=(lockstep_value_or_error&& other) noexcept(
      std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T>) {
    if (this != &other) take(std::move(other));
    return *this;
  }
  ~lockstep_value_or_error() { destroy(); }

 protected:
  struct OfValue {};
  struct OfError {};
  template <class... Arguments>
  explicit lockstep_value_or_error(OfValue /*unused*/, Arguments&&... arguments)
      : has_value_(true), value_(std::forward<Arguments>(arguments)...) {}
  explicit lockstep_value_or_error(OfError /*unused*/, Error&& error)
      : has_value_(false), error_(std::move(error)) {}

  bool has_value_;
  union {
    T value_;
    Error error_;
  };

 private:
  void destroy() {
    if (has_value_) {
      value_.~T();
    } else {
      error_.~Error();
    }
  }
  void take(lockstep_value_or_error&& other) {
    if (has_value_ && other.has_value_) {
      value_ = std::move(other.value_);
    } else if (!has_value_ && !other.has_value_) {
      error_ = std::move(other.error_);
    } else if (has_value_) {
      value_.~T();
      new (&error_) Error(std::move(other.error_));
      has_value_ = false;
    } else {
      Error before = std::move(error_);
      error_.~Error();
      if constexpr (std::is_nothrow_move_constructible_v<T>) {
        new (&value_) T(std::move(other.value_));
      } else {
        try {
          new (&value_) T(std::move(other.value_));
        } catch (...) {
          new (&error_) Error(std::move(before));
          throw;
        }
      }
      has_value_ = true;
    }
  }
};

// The base of a type that can be copied if T can.
struct lockstep_copied {};
struct lockstep_moved {
  lockstep_moved() = default;
  lockstep_moved(const lockstep_moved&) = delete;
  lockstep_moved(lockstep_moved&&) = default;
  lockstep_moved& operator=(const lockstep_moved&) = delete;
  lockstep_moved& operator=(lockstep_moved&&) = default;
};

template <class T, class Error>
class expected
    : private lockstep_value_or_error<T, Error>,
      private std::conditional_t<std::is_copy_constructible_v<T>, lockstep_copied, lockstep_moved> {
  using Base = lockstep_value_or_error<T, Error>;

 public:
  using value_type = T;
  using error_type = Error;

  template <class U = T, class = std::enable_if_t<std::is_default_constructible_v<U>>>
  expected() : Base(typename Base::OfValue()) {}
  template <class U = T,
            class = std::enable_if_t<
                std::is_constructible_v<T, U&&> && !std::is_same_v<std::decay_t<U>, expected> &&
                (std::is_convertible_v<U&&, T> || !std::is_class_v<std::decay_t<U>>)>>
  expected(U&& value)  // NOLINT: a value is an expected
      : Base(typename Base::OfValue(), std::forward<U>(value)) {}
  template <class Other, class = std::enable_if_t<std::is_constructible_v<Error, Other>>>
  expected(unexpected_type<Other> error)  // NOLINT: so is an error
      : Base(typename Base::OfError(), Error(std::move(error).error())) {}

  bool has_value() const noexcept { return this->has_value_; }
  explicit operator bool() const noexcept { return this->has_value_; }

  T& value() & { return checked(), this->value_; }
  const T& value() const& { return checked(), this->value_; }
  T&& value() && { return checked(), std::move(this->value_); }
  T& operator*() & { return this->value_; }
  const T& operator*() const& { return this->value_; }
  T&& operator*() && { return std::move(this->value_); }
  T* operator->() { return &this->value_; }
  const T* operator->() const { return &this->value_; }

  const Error& error() const& { return has_none(), this->error_; }
  Error& error() & { return has_none(), this->error_; }

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
    if (!this->has_value_) throw bad_expected_access<Error>(this->error_);
  }
  void has_none() const {
    if (this->has_value_) throw std::bad_variant_access();
  }
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
