// A port of any type: Input<Any>. A leaf learns whether its value has changed, and not what it is.
// Included by lockstep/leaf.hpp.
#pragma once

#include "../ext/changes.h"
#include "port.hpp"

namespace lockstep {
inline namespace sdk1 {

struct Any {};

namespace detail {

constexpr lockstep_port describe_any(const char* name, const char* doc) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = LOCKSTEP_ANY;
  port.direction = LOCKSTEP_INPUT;
  port.name = name;
  port.doc = doc;
  return port;
}

constexpr lockstep_port describe_any(const char* name, const char* default_entry, const char* doc) {
  if (is_for_constant() && !is_entry(default_entry)) error_default_of_any_type_is_an_entry();
  lockstep_port port = describe_any(name, doc);
  port.default_value = default_entry;
  port.flags = LOCKSTEP_DEFAULT_ENTRY;
  return port;
}

}  // namespace detail

template <>
class Input<Any> : public detail::Port {
 public:
  // `default_entry` is what the port is bound to where the tree leaves it out: "{goal}".
  constexpr Input(Ports* owner, const char* name, const char* default_entry, const char* doc)
      : Port(owner, detail::describe_any(name, default_entry, doc)) {}
  constexpr Input(Ports* owner, const char* name, Required, const char* doc)
      : Port(owner, detail::describe_any(name, doc)) {}

  // Whether it has another value than at the last call; at the first call, whether it has one. Two
  // objects differ, also where they look alike.
  bool changed() const {
    const detail::Caller& of = caller();
    if (changes_ == nullptr) {
      changes_ = static_cast<const lockstep_changes*>(of.host->get_extension(LOCKSTEP_CHANGES));
    }
    if (changes_ == nullptr) {
      throw std::runtime_error("this lockstep does not say whether port '" + std::string(name()) +
                               "' has changed: it is older than contract 1.4");
    }
    return changes_->changed(of.id, index());
  }

 private:
  mutable const lockstep_changes* changes_ = nullptr;
};

}  // namespace sdk1
}  // namespace lockstep
