// An entry of a blackboard in a run: its value, and what it may hold.
#pragma once

#include <cstdint>
#include <utility>

#include "base/core/value.h"

namespace lockstep::host {

enum class Typing : std::uint8_t {
  Strict,    // it holds values of its type only, and exists from the beginning to the end
  Declared,  // the first port that names it gives the type; a value of another kind may be in it
  Any        // nobody has declared a type: `type` has no meaning
};

// Whoever looks for changes compares counts, not values: a recorder and a property `changes`, a
// node such as EntryUpdated and a parameter that was read before `writes`. So a value that changes
// without a count is one that no watcher finds, and only `to_write` gives access to the value.
class Entry {
 public:
  Entry() = default;
  explicit Entry(Typing typing_at_first, ValueType its_type = ValueType::String,
                 const ObjectType* its_object = nullptr)
      : type(its_type), typing(typing_at_first), object(its_object) {}

  const Value& value() const { return value_; }  // NoValue: not written yet
  bool has_value() const { return !std::holds_alternative<NoValue>(value_); }
  // How often it was written since it was made. It may wrap, and begins at 0 again when the entry
  // is removed: an entry that is removed and written in each tick always has 1.
  std::uint32_t writes() const { return writes_; }
  // How often it was written in all.
  std::uint32_t changes() const { return before_ + writes_; }
  // It is made again, without a value.
  void make_again(Typing typing_again, ValueType its_type, const ObjectType* its_object) {
    const std::uint32_t before = changes();
    *this = Entry(typing_again, its_type, its_object);
    before_ = before;
  }

  // Counts a write, and returns what it changes in place.
  Value& to_write() {
    ++writes_;
    return value_;
  }
  // One that has a T gets another.
  template <class T>
  void assign_same(T value) {
    *std::get_if<T>(&to_write()) = value;
  }
  // A copy needs no memory where the entry has enough. What is moved in lets what the entry had be
  // released at the end: that finds the entry as it will be.
  void assign(const Value& value) { to_write() = value; }
  void assign(Value&& value) { std::swap(to_write(), value); }

  // Two states that differ in counts alone are one, as no later tick depends on them.
  void count_from(std::uint32_t writes) { writes_ = writes; }
  // An object whose plugin ends. Nobody looks at the entry any more.
  void forget_object() {
    if (std::holds_alternative<Object>(value_)) value_ = NoValue();
  }

 private:
  Value value_;
  std::uint32_t writes_ = 0;
  std::uint32_t before_ = 0;  // writes, before it was made

 public:
  ValueType type = ValueType::String;
  Typing typing = Typing::Strict;
  bool is_present = true;              // false: there is no such entry now
  const ObjectType* object = nullptr;  // of type Object: which
};

// Makes an entry that is not present, without a value.
inline void make_entry(Entry& entry, Typing typing, ValueType type = ValueType::String,
                       const ObjectType* object = nullptr) {
  entry.make_again(typing, type, object);
}

// Removes it: its value, its type and its count of writes are gone.
inline void unset_entry(Entry& entry) {
  make_entry(entry, Typing::Any);
  entry.is_present = false;
}

// Writes the value of a port of that type, and counts it. An entry without a type gets this type.
// For an entry of another type the value is converted; if it cannot be, returns false, and the
// entry stays as it was.
bool write_entry(Entry& entry, ValueType type, const ObjectType* object, Value value);

}  // namespace lockstep::host
