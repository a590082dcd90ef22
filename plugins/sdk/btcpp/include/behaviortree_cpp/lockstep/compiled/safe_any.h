// The functions of utils/safe_any.hpp. Included by it.
#pragma once

#include <memory>
#include <new>
#include <string>
#include <utility>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {

LOCKSTEP_BTCPP_INLINE const std::type_info& Any::castedType() const {
  switch (kind_) {
    case Kind::kNone:
      return typeid(void);
    case Kind::kWhole:
      return typeid(std::int64_t);
    case Kind::kUnsigned:
      return typeid(std::uint64_t);
    case Kind::kReal:
      return typeid(double);
    case Kind::kText:
      return typeid(std::string);
    default:
      return object_.ops->type;
  }
}

LOCKSTEP_BTCPP_INLINE void Any::copyInto(Any& other) const {
  if (other.empty() || castedType() == other.castedType()) {
    const std::type_index type = other.type_ == typeid(std::nullptr_t) ? type_ : other.type_;
    other = *this;
    other.type_ = type;
    return;
  }
  const bool is_held =
      isNumber() && ((other.kind_ == Kind::kWhole && to_number(other.whole_)) ||
                     (other.kind_ == Kind::kUnsigned && to_number(other.unsigned_)) ||
                     (other.kind_ == Kind::kReal && to_number(other.real_)));
  if (is_held) return;
  if (isNumber() && other.isString()) {
    other.text_ = number_text();
    return;
  }
  throw std::runtime_error(StrCat("Any::copyInto: a value of type ",
                                  lockstep_detail::readable(type_), " is none of type ",
                                  lockstep_detail::readable(other.type_)));
}

LOCKSTEP_BTCPP_INLINE std::string Any::number_text() const {
  if (kind_ == Kind::kWhole) return std::to_string(whole_);
  if (kind_ == Kind::kUnsigned) return std::to_string(unsigned_);
  return std::to_string(real_);
}

LOCKSTEP_BTCPP_INLINE void Any::hold(std::string text) {
  new (&text_) std::string(std::move(text));
  kind_ = Kind::kText;
}
LOCKSTEP_BTCPP_INLINE void Any::hold(std::shared_ptr<void> object, const Operations& ops) {
  new (&object_) Object{std::move(object), &ops};
  kind_ = Kind::kObject;
}
LOCKSTEP_BTCPP_INLINE void Any::hold_owned(const Any& other) {
  if (other.kind_ == Kind::kText) {
    hold(other.text_);
  } else {
    hold(other.object_.value, *other.object_.ops);
  }
}
LOCKSTEP_BTCPP_INLINE void Any::hold_owned(Any&& other) noexcept {
  if (other.kind_ == Kind::kText) {
    hold(std::move(other.text_));
  } else {
    hold(std::move(other.object_.value), *other.object_.ops);
  }
}
LOCKSTEP_BTCPP_INLINE void Any::destroy() noexcept {
  if (kind_ == Kind::kText) {
    text_.~basic_string();
  } else {
    object_.~Object();
  }
}

}  // namespace BT
