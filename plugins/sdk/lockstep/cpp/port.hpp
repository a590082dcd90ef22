// The ports of a leaf: members of a struct that derives from Ports. The struct is made once as a
// constant, for the descriptors, and once in every leaf, where its members read and write. Included
// by lockstep/leaf.hpp.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "port_traits.hpp"

namespace lockstep {
inline namespace sdk1 {

template <class T>
class Input;
template <class T>
class Output;
template <class T>
class InOut;

// In the place of a default: the tree must give this port.
struct Required {};

namespace detail {
class Port;
struct PortsAccess;
}  // namespace detail

class Ports {
 public:
  template <class T>
  using Input = sdk1::Input<T>;
  template <class T>
  using Output = sdk1::Output<T>;
  template <class T>
  using InOut = sdk1::InOut<T>;
  static constexpr Required required{};

  // The values that a port takes. Anything else is an error of the tree, or of the run when an
  // entry has it.
  static constexpr Limits between(double min, double max) { return {nullptr, min, max}; }
  static constexpr Limits at_least(double min) { return {nullptr, min, kInfinity}; }
  static constexpr Limits at_most(double max) { return {nullptr, -kInfinity, max}; }
  static constexpr Limits one_of(const char* words) { return {words, 0, 0}; }  // "soft;firm"

  constexpr Ports() = default;
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  friend class detail::Port;
  friend struct detail::PortsAccess;
  detail::Port* first_port_ = nullptr;
  detail::Port* last_port_ = nullptr;
  std::uint32_t port_count_ = 0;
  const detail::Caller* port_caller_ = nullptr;
};

namespace detail {

// A mistake in a port is found in the constant for the descriptors. The structs of the leaves say
// the same, and there is one for each leaf.
constexpr bool is_for_descriptors() {
  return __builtin_is_constant_evaluated();
}

class Port {
 public:
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  constexpr const char* name() const { return description_.name; }

 protected:
  constexpr Port(Ports* owner, const lockstep_port& description)
      : description_(description), owner_(owner), index_(owner->port_count_) {
    if (is_for_descriptors()) check_name(owner);
    (owner->port_count_ == 0 ? owner->first_port_ : owner->last_port_->next_) = this;
    owner->last_port_ = this;
    ++owner->port_count_;
  }

  const Caller& caller() const {
    if (!owner_->port_caller_) throw std::logic_error("a port outside of a leaf");
    owner_->port_caller_->require_run_thread();
    return *owner_->port_caller_;
  }
  std::uint32_t index() const { return index_; }
  // The value, if it is a constant that the host has told; else null.
  const void* constant() const { return constant_; }
  // The tree binds it to no entry, as the host has told.
  bool is_dropped() const { return is_dropped_; }

 private:
  friend struct PortsAccess;

  constexpr void check_name(const Ports* owner) const {
    const std::string_view name(description_.name);
    if (!is_name(name)) error_name_must_be_letters_digits_and_underscores();
    if (name == "name" || name == "ID") error_port_name_is_reserved_by_the_tree_language();
    // Counted: with -fsanitize=undefined, g++ takes no comparison with null for a constant.
    const Port* other = owner->first_port_;
    for (std::uint32_t i = 0; i < owner->port_count_; ++i, other = other->next_) {
      if (name == other->description_.name) error_two_ports_have_the_same_name();
    }
  }

  lockstep_port description_;
  const Ports* owner_;
  std::uint32_t index_;
  bool is_dropped_ = false;
  Port* next_ = nullptr;
  const void* constant_ = nullptr;
};

template <class T>
constexpr Limits all_limits(Limits limits) {
  if constexpr (std::is_enum_v<T>) limits.choices = PortTraits<T>::kWords;
  if (!is_for_descriptors()) return limits;
  constexpr auto kType = PortTraits<T>::kType;
  constexpr bool kIsNumber = kType == LOCKSTEP_NUMBER || kType == LOCKSTEP_INT ||
                             kType == LOCKSTEP_DOUBLE || kType == LOCKSTEP_INT_LIST ||
                             kType == LOCKSTEP_DOUBLE_LIST;
  if (limits.choices && kType != LOCKSTEP_STRING) error_only_a_string_has_choices();
  if (limits.choices && !are_choices(limits.choices)) {
    error_choices_are_different_words_separated_by_semicolons();
  }
  const bool has_range = limits.min != 0 || limits.max != 0;
  if (has_range && !kIsNumber) error_only_numbers_have_limits();
  if (!(limits.min <= limits.max)) error_limits_are_a_least_and_a_greatest_number();
  return limits;
}

template <class T>
constexpr const lockstep_object_type* object_of() {
  if constexpr (PortTraits<T>::kType == LOCKSTEP_OBJECT) {
    return PortTraits<T>::kObject;
  } else {
    return nullptr;
  }
}

// A port without a default.
template <class T>
constexpr lockstep_port describe(lockstep_direction direction, const char* name, const char* doc,
                                 const char* unit, Limits limits) {
  limits = all_limits<T>(limits);
  return {
      sizeof(lockstep_port), PortTraits<T>::kType, direction,  name,           nullptr, unit, doc,
      limits.choices,        limits.min,           limits.max, object_of<T>(), 0};
}

template <class T>
constexpr lockstep_port describe(lockstep_direction direction, const char* name,
                                 const char* default_value, const char* doc, const char* unit,
                                 Limits limits) {
  lockstep_port port = describe<T>(direction, name, doc, unit, limits);
  port.default_value = default_value;
  if (!is_for_descriptors()) return port;
  if (!PortTraits<T>::accepts(default_value)) error_default_is_not_a_value_of_the_port_type();
  if (port.choices && index_of(default_value, port.choices) >= count_words(port.choices)) {
    error_default_is_not_one_of_the_choices();
  }
  const bool has_range = port.min != 0 || port.max != 0;
  if (has_range && is_double(default_value) && !may_be_within(default_value, port.min, port.max)) {
    error_default_is_outside_the_limits();
  }
  return port;
}

// Refuses what was meant as a default: a doc that is a value.
template <class T>
constexpr lockstep_port describe_output(const char* name, const char* doc, const char* unit,
                                        Limits limits) {
  constexpr auto kType = PortTraits<T>::kType;
  constexpr bool kIsText = kType == LOCKSTEP_STRING || kType == LOCKSTEP_STRING_LIST;
  const bool is_value =
      is_for_descriptors() &&
      (is_double(doc) || (!kIsText && *doc != '\0' && PortTraits<T>::accepts(doc)));
  if (is_value) error_an_output_has_no_default();
  return describe<T>(LOCKSTEP_OUTPUT, name, doc, unit, limits);
}

template <class T>
class ReadablePort : public Port {
 public:
  using View = typename PortTraits<T>::View;

  // The value, the default until the entry is written; a std::runtime_error when there is none.
  T get() const { return from_view<T>(view()); }

  // Nothing if there is no value: no default, and bound to an entry that nobody has written yet.
  std::optional<T> try_get() const {
    if (const View* const known = constant_view()) return from_view<T>(*known);
    View value{};
    if (!PortTraits<T>::get(caller(), index(), value)) return std::nullopt;
    return from_view<T>(value);
  }

  // As get, without a copy: a std::string_view or a view of a list, valid until a port is set or
  // the function of the leaf returns.
  View view() const {
    const View* const known = constant_view();
    return known != nullptr ? *known : view_of_now();
  }

  // The tree gives a number or a bool that stays the same. An older host does not tell.
  bool is_constant() const { return constant() != nullptr; }

 protected:
  using Port::Port;

 private:
  View view_of_now() const {
    View value{};
    if (!PortTraits<T>::get(caller(), index(), value)) {
      throw std::runtime_error("port '" + std::string(name()) + "' has no value");
    }
    return value;
  }
  const View* constant_view() const {
    constexpr auto kType = PortTraits<T>::kType;
    if constexpr (kType == LOCKSTEP_BOOL || kType == LOCKSTEP_INT || kType == LOCKSTEP_DOUBLE) {
      caller();  // refuses the thread of a worker
      return static_cast<const View*>(constant());
    } else {
      return nullptr;
    }
  }
};

}  // namespace detail

template <class T>
class Input : public detail::ReadablePort<T> {
 public:
  // `default_value` as a tree would write it.
  constexpr Input(Ports* owner, const char* name, const char* default_value, const char* doc,
                  const char* unit = "", Limits limits = {})
      : detail::ReadablePort<T>(
            owner, detail::describe<T>(LOCKSTEP_INPUT, name, default_value, doc, unit, limits)) {}
  constexpr Input(Ports* owner, const char* name, const char* default_value, const char* doc,
                  Limits limits)
      : Input(owner, name, default_value, doc, "", limits) {}
  constexpr Input(Ports* owner, const char* name, Required, const char* doc, const char* unit = "",
                  Limits limits = {})
      : detail::ReadablePort<T>(owner,
                                detail::describe<T>(LOCKSTEP_INPUT, name, doc, unit, limits)) {}
  constexpr Input(Ports* owner, const char* name, Required, const char* doc, Limits limits)
      : Input(owner, name, Ports::required, doc, "", limits) {}
};

template <class T>
class Output : public detail::Port {
  static_assert(!std::is_same_v<T, Number>, "an output is an int or a double, not either");

 public:
  constexpr Output(Ports* owner, const char* name, const char* doc, const char* unit = "",
                   Limits limits = {})
      : Port(owner, detail::describe_output<T>(name, doc, unit, limits)) {}
  constexpr Output(Ports* owner, const char* name, const char* doc, Limits limits)
      : Output(owner, name, doc, "", limits) {}

  // Writes the entry that the tree binds to the port; false when it binds none, or when the host
  // refuses the value (a number that is not finite).
  bool set(const T& value) {
    const detail::Caller& to = caller();
    return !is_dropped() && detail::PortTraits<T>::set(to, index(), value);
  }
};

template <class T>
class InOut : public detail::ReadablePort<T> {
  static_assert(!std::is_same_v<T, Number>, "an output is an int or a double, not either");

 public:
  // The default is used until the entry is written; without an entry the port can be read but not
  // set.
  constexpr InOut(Ports* owner, const char* name, const char* default_value, const char* doc,
                  const char* unit = "", Limits limits = {})
      : detail::ReadablePort<T>(
            owner, detail::describe<T>(LOCKSTEP_INOUT, name, default_value, doc, unit, limits)) {}
  constexpr InOut(Ports* owner, const char* name, const char* default_value, const char* doc,
                  Limits limits)
      : InOut(owner, name, default_value, doc, "", limits) {}
  constexpr InOut(Ports* owner, const char* name, Required, const char* doc, const char* unit = "",
                  Limits limits = {})
      : detail::ReadablePort<T>(owner,
                                detail::describe<T>(LOCKSTEP_INOUT, name, doc, unit, limits)) {}
  constexpr InOut(Ports* owner, const char* name, Required, const char* doc, Limits limits)
      : InOut(owner, name, Ports::required, doc, "", limits) {}

  bool set(const T& value) {
    const detail::Caller& to = this->caller();
    return !this->is_dropped() && detail::PortTraits<T>::set(to, this->index(), value);
  }
};

// The ports of a leaf that has none.
struct NoPorts : Ports {};

namespace detail {

struct PortsAccess {
  static void bind(Ports& ports, const Caller& caller) {
    ports.port_caller_ = &caller;
    const void* const found = caller.host->get_extension(LOCKSTEP_LASTING);
    const auto* const lasting = static_cast<const lockstep_lasting*>(found);
    if (lasting == nullptr) return;
    for (Port* port = ports.first_port_; port != nullptr; port = port->next_) {
      port->constant_ = lasting->constant(caller.id, port->index_, port->description_.type);
      const bool is_input = port->description_.direction == LOCKSTEP_INPUT;
      port->is_dropped_ = !is_input && !lasting->is_set(caller.id, port->index_);
    }
  }
  static constexpr std::uint32_t count(const Ports& ports) { return ports.port_count_; }

  template <std::uint32_t Count>
  static constexpr std::array<const lockstep_port*, Count> list(const Ports& ports) {
    std::array<const lockstep_port*, Count> pointers{};
    const Port* port = ports.first_port_;
    for (std::uint32_t i = 0; i < Count; ++i, port = port->next_) {
      pointers[i] = &port->description_;
    }
    return pointers;
  }
};

// The descriptors of a struct of ports, without a leaf.
template <class PortsOfLeaf>
struct PortTable {
  static constexpr PortsOfLeaf kPorts = PortsOfLeaf();
  static constexpr std::uint32_t kCount = PortsAccess::count(kPorts);
  static constexpr std::array<const lockstep_port*, kCount> kList =
      PortsAccess::list<kCount>(kPorts);
};

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
