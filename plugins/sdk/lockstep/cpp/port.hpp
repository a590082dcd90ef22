// The ports of a leaf: members of a struct that derives from Ports. The struct is made in a
// constant, where the compiler finds mistakes, when the plugin is loaded, where its members write
// their descriptors, and in every leaf, where they read and write values. Included by
// lockstep/leaf.hpp.
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
template <class T>
class Fixed;

// In the place of a default: the tree must give this port.
struct Required {};
// In the place of a default: the tree may leave the port out, and then it has no value.
struct Optional {};

namespace detail {

class Port;
struct PortsAccess;

// A mistake in a port is found in a constant. The structs of the leaves have the same mistake, and
// there is one for each leaf.
constexpr bool is_for_constant() {
  return __builtin_is_constant_evaluated();
}

// Where the ports that this thread makes write their descriptors; null: nowhere.
inline thread_local lockstep_port* describing = nullptr;
constexpr lockstep_port* descriptors_of_ports() {
  return is_for_constant() ? nullptr : describing;
}

}  // namespace detail

class Ports {
 public:
  template <class T>
  using Input = sdk1::Input<T>;
  template <class T>
  using Output = sdk1::Output<T>;
  template <class T>
  using InOut = sdk1::InOut<T>;
  template <class T>
  using Fixed = sdk1::Fixed<T>;
  static constexpr Required required{};
  static constexpr Optional optional{};

  // The values that a port takes. Anything else is an error of the tree, or of the run when an
  // entry has it.
  static constexpr Limits between(double min, double max) { return {nullptr, min, max}; }
  static constexpr Limits at_least(double min) { return {nullptr, min, kInfinity}; }
  static constexpr Limits at_most(double max) { return {nullptr, -kInfinity, max}; }
  static constexpr Limits one_of(const char* words) { return {words, 0, 0}; }  // "soft;firm"

  constexpr Ports() : descriptors_(detail::descriptors_of_ports()) {}
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  friend class detail::Port;
  friend struct detail::PortsAccess;
  detail::Port* last_port_ = nullptr;
  const detail::Caller* port_caller_ = nullptr;
  lockstep_port* descriptors_;  // where each port writes its descriptor; null: in a leaf
  std::uint32_t port_count_ = 0;
};

namespace detail {

class Port {
 public:
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  constexpr const char* name() const { return name_; }

 protected:
  constexpr Port(Ports* owner, const lockstep_port& descriptor)
      : name_(descriptor.name),
        owner_(owner),
        before_(owner->last_port_),
        type_(descriptor.type),
        index_(static_cast<std::uint16_t>(owner->port_count_)),
        is_input_(descriptor.direction == LOCKSTEP_INPUT) {
    if (is_for_constant()) check_name(owner);
    if (owner->descriptors_) owner->descriptors_[index_] = descriptor;
    owner->last_port_ = this;
    ++owner->port_count_;
  }

  const Caller& caller() const {
    if (!owner_->port_caller_) throw std::logic_error("a port outside of a leaf");
    owner_->port_caller_->require_run_thread();
    return *owner_->port_caller_;
  }
  std::uint32_t index() const { return index_; }
  // The value, if it is a constant that the host has given; otherwise null.
  const void* constant() const { return constant_; }
  // The tree binds it to no entry, as the host has reported.
  bool is_dropped() const { return is_dropped_; }

 private:
  friend struct PortsAccess;

  constexpr void check_name(const Ports* owner) const {
    const std::string_view name(name_);
    if (!is_name(name)) error_name_must_be_letters_digits_and_underscores();
    if (name == "name" || name == "ID") error_port_name_is_reserved_by_the_tree_language();
    // Counted: with -fsanitize=undefined, g++ takes no comparison with null for a constant.
    const Port* other = owner->last_port_;
    for (std::uint32_t i = 0; i < owner->port_count_; ++i, other = other->before_) {
      if (name == other->name_) error_two_ports_have_the_same_name();
    }
  }

  // There is one for each port of each leaf, so what only the descriptor needs is not here.
  const void* constant_ = nullptr;
  const char* name_;
  const Ports* owner_;
  Port* before_;
  lockstep_type type_;
  std::uint16_t index_;
  bool is_input_;
  bool is_dropped_ = false;
};

template <class T>
constexpr Limits all_limits(Limits limits) {
  if constexpr (std::is_enum_v<T>) limits.choices = PortTraits<T>::kWords;
  if (!is_for_constant()) return limits;
  constexpr auto kType = PortTraits<T>::kType;
  if (limits.choices && kType != LOCKSTEP_STRING) error_only_a_string_has_choices();
  if (limits.choices && !are_choices(limits.choices)) {
    error_choices_are_different_words_separated_by_semicolons();
  }
  const bool has_range = limits.min != 0 || limits.max != 0;
  if (has_range && !has_numbers<T>) error_only_numbers_have_limits();
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
  if (is_entry(default_value)) {
    port.flags = LOCKSTEP_DEFAULT_ENTRY;
    return port;
  }
  if (!is_for_constant()) return port;
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

constexpr lockstep_port with_flags(lockstep_port port, std::uint64_t flags) {
  port.flags = flags;
  return port;
}

// Refuses what was meant as a default: a doc that is a value.
template <class T>
constexpr lockstep_port describe_output(const char* name, const char* doc, const char* unit,
                                        Limits limits) {
  constexpr auto kType = PortTraits<T>::kType;
  constexpr bool kIsText = kType == LOCKSTEP_STRING || kType == LOCKSTEP_STRING_LIST;
  const bool is_value =
      is_for_constant() &&
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

  // Nothing if there is no value: no default, and bound to an entry that has not been written yet.
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

  // The tree gives a number or a bool that stays the same. An older host does not report it.
  bool is_constant() const { return constant() != nullptr; }

 protected:
  using Port::Port;

 private:
  // Apart, so that the way of a constant is in line also in a large plugin.
  [[gnu::noinline]] View view_of_now() const {
    View value{};
    if (!PortTraits<T>::get(caller(), index(), value)) {
      throw EmptyPort(index(), name());
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
  // `default_value` as a tree would write it: a constant, or "{key}".
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
  constexpr Input(Ports* owner, const char* name, Optional, const char* doc, const char* unit = "",
                  Limits limits = {})
      : detail::ReadablePort<T>(
            owner, detail::with_flags(detail::describe<T>(LOCKSTEP_INPUT, name, doc, unit, limits),
                                      LOCKSTEP_OPTIONAL)) {}
  constexpr Input(Ports* owner, const char* name, Optional, const char* doc, Limits limits)
      : Input(owner, name, Ports::optional, doc, "", limits) {}
};

// An input for which a tree gives a constant: it may decide which ports the element has, see
// cpp/element.hpp.
template <class T>
class Fixed : public detail::ReadablePort<T> {
 public:
  constexpr Fixed(Ports* owner, const char* name, const char* default_value, const char* doc,
                  const char* unit = "", Limits limits = {})
      : detail::ReadablePort<T>(
            owner, detail::with_flags(
                       detail::describe<T>(LOCKSTEP_INPUT, name, default_value, doc, unit, limits),
                       LOCKSTEP_FIXED)) {}
  constexpr Fixed(Ports* owner, const char* name, const char* default_value, const char* doc,
                  Limits limits)
      : Fixed(owner, name, default_value, doc, "", limits) {}
  constexpr Fixed(Ports* owner, const char* name, Required, const char* doc, const char* unit = "",
                  Limits limits = {})
      : detail::ReadablePort<T>(
            owner, detail::with_flags(detail::describe<T>(LOCKSTEP_INPUT, name, doc, unit, limits),
                                      LOCKSTEP_FIXED)) {}
  constexpr Fixed(Ports* owner, const char* name, Required, const char* doc, Limits limits)
      : Fixed(owner, name, Ports::required, doc, "", limits) {}
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
    for (Port* port = ports.last_port_; port != nullptr; port = port->before_) {
      port->constant_ = lasting->constant(caller.id, port->index_, port->type_);
      port->is_dropped_ = !port->is_input_ && !lasting->is_set(caller.id, port->index_);
    }
  }
  static constexpr std::uint32_t count(const Ports& ports) { return ports.port_count_; }
};

// The descriptors of a struct of ports, without a leaf. They are written when the plugin is loaded.
template <class PortsOfLeaf>
struct PortTable {
  static constexpr std::uint32_t count() {
    PortsOfLeaf ports;
    return PortsAccess::count(ports);
  }
  static constexpr std::uint32_t kCount = count();
  using Descriptors = std::array<lockstep_port, kCount>;

  static Descriptors describe() {
    Descriptors all{};
    describing = all.data();
    PortsOfLeaf ports;
    static_cast<void>(ports);
    describing = nullptr;
    return all;
  }
  static inline const Descriptors kDescriptors = describe();

  static constexpr std::array<const lockstep_port*, kCount> list() {
    std::array<const lockstep_port*, kCount> pointers{};
    for (std::uint32_t i = 0; i < kCount; ++i) pointers[i] = kDescriptors.data() + i;
    return pointers;
  }
  static constexpr std::array<const lockstep_port*, kCount> kList = list();
};

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
