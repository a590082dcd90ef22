// The values with which a running script computes, each a view. Texts and others belong to the
// program, to an entry, or to the evaluator.
#pragma once

#include <cstdint>
#include <string>

#include "base/core/value.h"

namespace lockstep::host {

struct Operand {
  enum class Kind : std::uint8_t { Empty, Whole, Real, Text, Other };

  Operand() = default;
  // Field by field: a copy of all 16 bytes would wait for both fields to be stored.
  Operand(const Operand& from) : kind(from.kind), whole(from.whole) {}
  Operand& operator=(const Operand& from) {
    kind = from.kind;
    whole = from.whole;
    return *this;
  }

  static Operand of(const Value& value) {
    if (const auto* real = std::get_if<double>(&value)) return of(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return of(*whole);
    if (const auto* flag = std::get_if<bool>(&value)) return of(std::int64_t{*flag ? 1 : 0});
    if (const auto* text = std::get_if<std::string>(&value)) return of(text);
    if (std::holds_alternative<NoValue>(value)) return {};
    Operand it;
    it.kind = Kind::Other;
    it.other = &value;
    return it;
  }
  static Operand of(double real) {
    Operand it;
    it.kind = Kind::Real;
    it.real = real;
    return it;
  }
  static Operand of(std::int64_t whole) {
    Operand it;
    it.kind = Kind::Whole;
    it.whole = whole;
    return it;
  }
  static Operand of(const std::string* text) {
    Operand it;
    it.kind = Kind::Text;
    it.text = text;
    return it;
  }

  bool is_number() const { return kind == Kind::Whole || kind == Kind::Real; }
  Value value() const;
  // The same into `out`.
  void store(Value& out) const {
    auto* const held_real = std::get_if<double>(&out);
    auto* const held_whole = std::get_if<std::int64_t>(&out);
    if (held_real != nullptr && kind == Kind::Real) {
      *held_real = real;
    } else if (held_whole != nullptr && kind == Kind::Whole) {
      *held_whole = whole;
    } else {
      out = value();
    }
  }
  // For messages: "5", "the text 'abc'", "an empty entry", "a list of double".
  std::string shown() const;

  Kind kind = Kind::Empty;
  union {
    std::int64_t whole = 0;
    double real;
    const std::string* text;
    const Value* other;
  };
};

}  // namespace lockstep::host
