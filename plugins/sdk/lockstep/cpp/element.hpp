// Ports by pattern: a class defines which names its elements may have in addition to its ports, and
// describes one element. Included by lockstep/leaf.hpp.
//
//   static constexpr const char* more_ports = "goal.*;result.*";
//   static void describe(lockstep::Element& element) {
//     element.input<double>("goal.x", optional, "where to, in " + element["frame"], "m");
//   }
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "action.hpp"

namespace lockstep {
inline namespace sdk1 {

// Why an element has no ports: `describe` throws it. `port` is the Fixed port whose text is to
// blame; "": the element as a whole. In lower case, names in single quotes, without a full stop.
struct Refusal : std::runtime_error {
  Refusal(std::string of, const std::string& message, std::string what_to_do = "")
      : std::runtime_error(message), port(std::move(of)), hint(std::move(what_to_do)) {}
  std::string port, hint;
};

namespace detail {

template <class T>
inline constexpr char kKeptType = 0;

// The type of the elements with the same constants. lockstep_leaf_type::data points to it.
struct DescribedElement {
  lockstep_leaf_type type{};
  std::vector<const lockstep_port*> ports;  // those of the class first
  std::deque<lockstep_port> more;
  std::deque<std::string> texts;
  std::shared_ptr<const void> kept;
  const void* kept_type = nullptr;
};

struct ElementAccess {
  static const Caller& caller(const Leaf& leaf) { return leaf.caller_; }
  static const DescribedElement& element(const Leaf& leaf);
};

struct Describing;

}  // namespace detail

// One element, to which `describe` gives ports. The words are those of the members of Ports.
class Element {
 public:
  // The text that the element gives to a Fixed port, or the port's default; "" without both.
  std::string operator[](std::string_view fixed_port) const {
    for (const auto& [port, text] : fixed_) {
      if (port == fixed_port) return text;
    }
    return {};
  }

  template <class T>
  void input(const std::string& name, const std::string& default_value, const std::string& doc,
             const std::string& unit = "", Limits limits = {}) {
    add<T>(LOCKSTEP_INPUT, name, &default_value, doc, unit, limits, 0);
  }
  template <class T>
  void input(const std::string& name, Required, const std::string& doc,
             const std::string& unit = "", Limits limits = {}) {
    add<T>(LOCKSTEP_INPUT, name, nullptr, doc, unit, limits, 0);
  }
  template <class T>
  void input(const std::string& name, Optional, const std::string& doc,
             const std::string& unit = "", Limits limits = {}) {
    add<T>(LOCKSTEP_INPUT, name, nullptr, doc, unit, limits, LOCKSTEP_OPTIONAL);
  }
  template <class T>
  void output(const std::string& name, const std::string& doc, const std::string& unit = "",
              Limits limits = {}) {
    static_assert(!std::is_same_v<T, Number>, "an output is an int or a double, not either");
    add<T>(LOCKSTEP_OUTPUT, name, nullptr, doc, unit, limits, 0);
  }
  template <class T>
  void inout(const std::string& name, Optional, const std::string& doc,
             const std::string& unit = "", Limits limits = {}) {
    static_assert(!std::is_same_v<T, Number>, "an output is an int or a double, not either");
    add<T>(LOCKSTEP_INOUT, name, nullptr, doc, unit, limits, LOCKSTEP_OPTIONAL);
  }

  // The leaves of such elements find it with kept<T>(): a type that was looked up, a plan.
  template <class T>
  void keep(T value) {
    made_.kept = std::make_shared<const T>(std::move(value));
    made_.kept_type = &detail::kKeptType<T>;
  }

 private:
  friend struct detail::Describing;
  using Texts = std::vector<std::pair<std::string, std::string>>;
  Element(const Texts& fixed, detail::DescribedElement& made) : fixed_(fixed), made_(made) {}

  const char* text(const std::string& text) { return made_.texts.emplace_back(text).c_str(); }
  template <class T>
  void add(lockstep_direction direction, const std::string& name, const std::string* default_value,
           const std::string& doc, const std::string& unit, Limits limits, std::uint64_t flags) {
    lockstep_port port = detail::describe<T>(direction, text(name), text(doc), text(unit), limits);
    if (port.choices != nullptr) port.choices = text(port.choices);
    if (default_value != nullptr) port.default_value = text(*default_value);
    port.flags = flags;
    made_.ports.push_back(&made_.more.emplace_back(port));
  }

  const Texts& fixed_;
  detail::DescribedElement& made_;
};

// A port that `describe` has given to the leaf's element, by its name: a member of the leaf, made
// with it. Of another type, or of a name that the element does not have, it is an error of the
// leaf.
template <class T>
class MorePort {
 public:
  using View = typename detail::PortTraits<T>::View;

  MorePort(const Leaf* leaf, std::string_view name)
      : caller_(detail::ElementAccess::caller(*leaf)), index_(find(*leaf, name)), name_(name) {}

  const std::string& name() const { return name_; }
  // As those of the other ports.
  T get() const { return detail::from_view<T>(view()); }
  std::optional<T> try_get() const {
    View value{};
    if (!detail::PortTraits<T>::get(caller(), index_, value)) return std::nullopt;
    return detail::from_view<T>(value);
  }
  View view() const {
    View value{};
    if (!detail::PortTraits<T>::get(caller(), index_, value)) {
      throw detail::EmptyPort(index_, name_);
    }
    return value;
  }
  bool set(const T& value) { return detail::PortTraits<T>::set(caller(), index_, value); }

 private:
  static std::uint32_t find(const Leaf& leaf, std::string_view name) {
    const auto& ports = detail::ElementAccess::element(leaf).ports;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (name != ports[i]->name) continue;
      if (ports[i]->type == detail::PortTraits<T>::kType) return static_cast<std::uint32_t>(i);
      throw std::logic_error("its port '" + std::string(name) + "' has another type");
    }
    throw std::logic_error("it has no port '" + std::string(name) + "'");
  }
  const detail::Caller& caller() const {
    caller_.require_run_thread();
    return caller_;
  }

  const detail::Caller& caller_;
  std::uint32_t index_;
  std::string name_;
};

// The value that `describe` has kept for the leaf's element.
template <class T>
const T& kept(const Leaf& leaf) {
  const detail::DescribedElement& element = detail::ElementAccess::element(leaf);
  if (element.kept_type != &detail::kKeptType<T>) {
    throw std::logic_error("its describe keeps no value of this type");
  }
  return *static_cast<const T*>(element.kept.get());
}

namespace detail {

inline const DescribedElement& ElementAccess::element(const Leaf& leaf) {
  const Caller& caller = leaf.caller_;
  constexpr std::size_t kSize = offsetof(lockstep_place, data) + sizeof(lockstep_place::data);
  const void* const found = caller.host->get_extension(LOCKSTEP_PLACE);
  const auto* const place = static_cast<const lockstep_place*>(found);
  const bool is_known = place != nullptr && place->struct_size >= kSize;
  const void* const data = is_known ? place->data(caller.id) : nullptr;
  if (data == nullptr) throw std::logic_error("nobody has described its element");
  return *static_cast<const DescribedElement*>(data);
}

using DescribeFunction = const lockstep_leaf_type* (*)(const lockstep_fixed*, std::uint32_t,
                                                       lockstep_refusal*);

// The leaf types of this plugin that describe elements.
inline std::vector<const lockstep_leaf_type*>& describing_types() {
  static std::vector<const lockstep_leaf_type*> all;
  return all;
}

struct Describing {
  using Texts = Element::Texts;

  // `describe` is the function of the leaf type, `give_ports` that of its class.
  static const lockstep_leaf_type* describe(DescribeFunction describe, void (*give_ports)(Element&),
                                            const lockstep_fixed* fixed, std::uint32_t count,
                                            lockstep_refusal* why) noexcept {
    const lockstep_leaf_type* type = nullptr;
    catching(
        [&] {
          Texts texts;
          for (std::uint32_t i = 0; i < count; ++i)
            texts.emplace_back(fixed[i].port, fixed[i].text);
          try {
            type = type_of(*base_of(describe), std::move(texts), give_ports);
          } catch (const Refusal& refusal) {
            refuse(*why, refusal.what(), refusal.port, refusal.hint);
          }
        },
        [&](const char* message) { refuse(*why, message, "", ""); });
    return type;
  }

 private:
  static const lockstep_leaf_type* base_of(DescribeFunction describe) {
    for (const lockstep_leaf_type* type : describing_types()) {
      if (type->describe == describe) return type;
    }
    throw std::logic_error("the plugin is not ready");
  }

  // They are never freed: leaves and hosts point to them.
  static const lockstep_leaf_type* type_of(const lockstep_leaf_type& base, Texts fixed,
                                           void (*give_ports)(Element&)) {
    using Key = std::pair<const lockstep_leaf_type*, Texts>;
    static std::mutex mutex;
    static auto& known = *new std::map<Key, std::unique_ptr<DescribedElement>>;
    const std::lock_guard<std::mutex> lock(mutex);
    Key key(&base, std::move(fixed));
    const auto found = known.find(key);
    if (found != known.end()) return &found->second->type;
    auto made = std::make_unique<DescribedElement>();
    made->ports.assign(base.ports, base.ports + base.port_count);
    Element element(key.second, *made);
    give_ports(element);
    made->type = base;
    made->type.more_ports = nullptr;
    made->type.describe = nullptr;
    made->type.ports = made->ports.data();
    made->type.port_count = static_cast<std::uint32_t>(made->ports.size());
    made->type.data = made.get();
    return &known.emplace(std::move(key), std::move(made)).first->second->type;
  }

  // The host reads the texts before this thread describes another element.
  static void refuse(lockstep_refusal& why, const std::string& message, const std::string& port,
                     const std::string& hint) {
    static thread_local std::string texts[3];
    texts[0] = message;
    texts[1] = port;
    texts[2] = hint;
    why.message = texts[0].c_str();
    why.port = port.empty() ? nullptr : texts[1].c_str();
    why.hint = hint.empty() ? nullptr : texts[2].c_str();
  }
};

// The part of a leaf type that describes elements, where class T does.
template <class T, class = void>
struct DescribeOf {
  static constexpr void add(lockstep_leaf_type&) {}
};
template <class T>
struct DescribeOf<T, std::void_t<decltype(T::more_ports)>> {
  static const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                            lockstep_refusal* why) {
    return Describing::describe(&DescribeOf::describe, &T::describe, fixed, count, why);
  }
  static constexpr void add(lockstep_leaf_type& type) {
    static_assert(std::is_convertible_v<decltype(&T::describe), void (*)(Element&)>,
                  "write: static void describe(lockstep::Element& element)");
    type.more_ports = T::more_ports;
    type.describe = &DescribeOf::describe;
  }
};

// Nothing is done at run time for a plugin whose elements are all alike.
template <std::size_t Count>
constexpr bool remember_describing(const std::array<const lockstep_leaf_type*, Count>& leaves) {
  for (std::size_t i = 0; i < Count; ++i) {
    if (leaves[i]->describe != nullptr) describing_types().push_back(leaves[i]);
  }
  return true;
}

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
