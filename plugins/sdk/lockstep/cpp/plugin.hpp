// From classes to the C tables of a plugin, as constants; and the macro that exports them. Included
// by lockstep/leaf.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "control.hpp"
#include "element.hpp"

namespace lockstep {
inline namespace sdk1 {

// A statement about what a leaf does, of its class: `lockstep verify` relies on it.
//   static constexpr lockstep::Behavior behavior[] = {{"result", "success"}, {"ticks", "2..40"}};
using Behavior = lockstep_behavior;

namespace detail {

struct LeafAccess {
  static const Caller& caller(const Leaf& leaf) { return leaf.caller_; }
  static void before_destroy(ActionFunctions& action) { action.before_destroy(); }
  static void before_destroy(ConditionFunctions&) {}
  template <class T>
  static constexpr bool keeps_progress() {
    return T::kKeepsProgress;
  }
  static void before_start(ActionFunctions& action) { action.before_start(); }
  static void before_pace(ActionFunctions& action, double factor) { action.before_pace(factor); }
  static const double* kept_progress(const ActionFunctions& action) {
    return action.kept_progress();
  }
};

template <class T>
inline constexpr bool kHasKept = std::is_base_of_v<KeptBase, T>;

// The State of a Kept<State>.
struct KeptAccess {
  template <class T>
  static auto& of(T& leaf) {
    static_assert(std::is_convertible_v<T*, const KeptBase*>,
                  "write: public lockstep::Kept<State>");
    return leaf.Kept<typename T::KeptState>::kept;
  }
  template <class T>
  static void reset(T& leaf) {
    if constexpr (kHasKept<T>) of(leaf) = {};
  }
  template <class T>
  static AfterCut after_cut(T& leaf, const Cut& cut) {
    return static_cast<Kept<typename T::KeptState>&>(leaf).after_cut(cut);
  }
};

template <class T>
inline constexpr bool kOverridesSave =
    !std::is_same_v<decltype(&T::save), std::size_t (ActionFunctions::*)(void*, std::size_t) const>;

template <class T>
inline constexpr bool kOverridesPace =
    !std::is_same_v<decltype(&T::set_pace), double (ActionFunctions::*)(double)>;

// The functions of the C table for leaf class T, which must be public in T.
template <class T>
struct LeafFunctions {
  static constexpr bool kIsAction = std::is_base_of_v<ActionFunctions, T>;
  static_assert(
      kIsAction || std::is_base_of_v<ConditionFunctions, T>,
      "a node derives from lockstep::Action, Condition, ThreadedAction, Control or Decorator");

  static void* create(const lockstep_host* host, const lockstep_caller* id, void* run_context) {
    const Caller caller{host, id, run_context};
    return guarded(caller, static_cast<void*>(nullptr), [&]() -> void* {
      const Creating scope(caller);
      return new T();
    });
  }
  static void destroy(void* leaf) {
    T* object = static_cast<T*>(leaf);
    LeafAccess::before_destroy(*object);
    delete object;  // its destructor is virtual and so noexcept: the compiler refuses another
  }
  static lockstep_status tick(void* leaf) {
    T& object = *static_cast<T*>(leaf);
    return guarded(LeafAccess::caller(object), lockstep_status{LOCKSTEP_FAILURE}, [&] {
      if constexpr (kIsAction) {
        return static_cast<lockstep_status>(object.tick());
      } else {
        return lockstep_status{object.check() ? LOCKSTEP_SUCCESS : LOCKSTEP_FAILURE};
      }
    });
  }
  static void start(void* leaf) {
    KeptAccess::reset(*static_cast<T*>(leaf));
    LeafAccess::before_start(*static_cast<T*>(leaf));
    call(leaf, &T::start);
  }
  static void start_unreset(void* leaf) {
    KeptAccess::reset(*static_cast<T*>(leaf));
    LeafAccess::before_start(*static_cast<T*>(leaf));
    call(leaf, &T::start_unreset);
  }
  static void halt(void* leaf) { call(leaf, &T::halt); }
  static void pause(void* leaf) { call(leaf, &T::pause); }
  static void resume(void* leaf) { call(leaf, &T::resume); }
  static double progress(void* leaf) {
    const T& object = *static_cast<T*>(leaf);
    return guarded(LeafAccess::caller(object), 0.0, [&] { return object.progress(); });
  }
  static double set_pace(void* leaf, double factor) {
    T& object = *static_cast<T*>(leaf);
    return guarded(LeafAccess::caller(object), 1.0, [&] {
      LeafAccess::before_pace(object, factor);
      return kOverridesPace<T> ? object.set_pace(factor) : factor;
    });
  }
  static std::size_t save(void* leaf, void* bytes, std::size_t room) {
    const T& object = *static_cast<T*>(leaf);
    if constexpr (kHasKept<T>) {
      static_assert(!kOverridesSave<T>, "a leaf with a Kept<State> does not override save()");
      std::memcpy(bytes, &KeptAccess::of(object), sizeof(typename T::KeptState));
      return sizeof(typename T::KeptState);
    } else {
      return guarded(LeafAccess::caller(object), std::size_t{0},
                     [&] { return object.save(bytes, room); });
    }
  }
  static lockstep_after_cut restore(void* leaf, const void* bytes, std::size_t size,
                                    const lockstep_cut* cut) {
    T& object = *static_cast<T*>(leaf);
    const auto answer = guarded(LeafAccess::caller(object), AfterCut::StartsAgain, [&] {
      LeafAccess::before_start(object);
      if constexpr (kHasKept<T>) {
        if (size != sizeof(typename T::KeptState)) return AfterCut::StartsAgain;
        std::memcpy(&KeptAccess::of(object), bytes, size);
        return KeptAccess::after_cut(object, *cut);
      } else {
        return object.restore({static_cast<const char*>(bytes), size}, *cut);
      }
    });
    return static_cast<lockstep_after_cut>(answer);
  }
  static const void* get_extension(void* leaf, const char* id) {
    const bool is_known = std::string_view(id) == LOCKSTEP_KEPT_PROGRESS;
    return is_known ? LeafAccess::kept_progress(*static_cast<T*>(leaf)) : nullptr;
  }

 private:
  struct Creating {
    explicit Creating(const Caller& caller) { creating = &caller; }
    ~Creating() { creating = nullptr; }
    Creating(const Creating&) = delete;
    Creating& operator=(const Creating&) = delete;
  };
  static void call(void* leaf, void (T::*function)()) {
    T* object = static_cast<T*>(leaf);
    guarded(LeafAccess::caller(*object), true, [&] {
      (object->*function)();
      return true;
    });
  }
};

// A pointer to a member function has the class that declares it in its type. This distinguishes an
// overridden function from one that was left alone.
template <class Own, class Inherited>
inline constexpr bool is_overridden = !std::is_same_v<Own, Inherited>;

template <class T>
constexpr void add_optional_functions(lockstep_leaf_type& type) {
  using Functions = LeafFunctions<T>;
  using Nothing = void (ActionFunctions::*)();
  using NoProgress = double (ActionFunctions::*)() const;
  constexpr bool kKeepsProgress = LeafAccess::keeps_progress<T>();
  if constexpr (kKeepsProgress || kHasKept<T> || is_overridden<decltype(&T::start), Nothing>) {
    type.start = &Functions::start;
  }
  if constexpr (is_overridden<decltype(&T::start_unreset), Nothing>) {
    type.start_unreset = &Functions::start_unreset;
  }
  if constexpr (is_overridden<decltype(&T::halt), Nothing>) type.halt = &Functions::halt;
  if constexpr (is_overridden<decltype(&T::pause), Nothing>) type.pause = &Functions::pause;
  if constexpr (is_overridden<decltype(&T::resume), Nothing>) type.resume = &Functions::resume;
  if constexpr (is_overridden<decltype(&T::progress), NoProgress>) {
    type.progress = &Functions::progress;
  }
  if constexpr (T::kPaces || kOverridesPace<T>) {
    type.set_pace = &Functions::set_pace;
  }
  if constexpr (kHasKept<T> || kOverridesSave<T>) {
    type.save = &Functions::save;
    type.restore = &Functions::restore;
  }
  if constexpr (kKeepsProgress) type.get_extension = &Functions::get_extension;
}

struct RunContextPart {
  void* (*create)(const lockstep_host*, const lockstep_caller*);
  void (*destroy)(void*);
};
struct InitPart {
  bool (*function)(const lockstep_host*, const lockstep_caller*);
};
struct DeinitPart {
  void (*function)();
};

// The statements of T about what it does: its member `behavior`, if it has one.
template <class T, class = void>
struct BehaviorOf {
  static constexpr void add(lockstep_leaf_type&) {}
};
template <class T>
struct BehaviorOf<
    T,
    std::enable_if_t<std::is_same_v<std::remove_extent_t<decltype(T::behavior)>, const Behavior>>> {
  static_assert(
      std::is_array_v<decltype(T::behavior)>,
      "write: static constexpr lockstep::Behavior behavior[] = {{\"ticks\", \"2..40\"}};");
  static constexpr void add(lockstep_leaf_type& type) {
    type.behavior = &T::behavior[0];
    type.behavior_count = static_cast<std::uint32_t>(std::extent_v<decltype(T::behavior)>);
  }
};

// All of a plugin but the pointers to its own parts.
template <std::size_t LeafCount>
struct PluginParts {
  lockstep_plugin plugin{};
  std::array<lockstep_leaf_type, LeafCount> leaves{};
  std::size_t count = 0;

  // With -fsanitize=undefined, g++ takes no comparison of functions for a constant: false then.
  template <class Function>
  static constexpr bool is_same(Function one, Function other) {
    return __builtin_constant_p(one == other) && one == other;
  }
  constexpr void add(const lockstep_leaf_type& leaf) {
    for (std::size_t i = 0; i < count; ++i) {
      if (std::string_view(leaves[i].id) == leaf.id) error_two_leaves_have_the_same_id();
      if (leaf.more_ports != nullptr && is_same(leaves[i].describe, leaf.describe)) {
        error_a_class_that_describes_elements_is_one_leaf();
      }
    }
    leaves[count++] = leaf;
  }
  constexpr void add(RunContextPart part) {
    require_first(plugin.create_run);
    plugin.create_run = part.create;
    plugin.destroy_run = part.destroy;
  }
  constexpr void add(InitPart part) {
    require_first(plugin.init);
    plugin.init = part.function;
  }
  constexpr void add(DeinitPart part) {
    require_first(plugin.deinit);
    plugin.deinit = part.function;
  }

 private:
  template <class Function>
  static constexpr void require_first(Function present) {
    if (present) error_a_plugin_has_at_most_one_run_context_init_and_deinit();
  }
};

template <class... Parts>
constexpr auto parts(const char* name, const char* version, const char* doc, Parts... all) {
  if (!is_plugin_name(name)) error_plugin_name_must_be_letters_digits_underscores_and_dashes();
  constexpr std::size_t kLeaves =
      (std::size_t{0} + ... + (std::is_same_v<Parts, lockstep_leaf_type> ? 1 : 0));
  static_assert(kLeaves > 0, "a plugin has at least one leaf");
  PluginParts<kLeaves> result;
  result.plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  result.plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  result.plugin.struct_size = sizeof(lockstep_plugin);
  result.plugin.name = name;
  result.plugin.version = version;
  result.plugin.doc = doc;
  (result.add(all), ...);
  return result;
}

template <std::size_t Count>
constexpr auto pointers(const PluginParts<Count>& parts) {
  std::array<const lockstep_leaf_type*, Count> list{};
  for (std::size_t i = 0; i < Count; ++i) list[i] = &parts.leaves[i];
  return list;
}

template <std::size_t Count>
constexpr lockstep_plugin plugin(const PluginParts<Count>& parts,
                                 const std::array<const lockstep_leaf_type*, Count>& leaves) {
  lockstep_plugin result = parts.plugin;
  result.leaf_type_count = static_cast<std::uint32_t>(Count);
  result.leaf_types = leaves.data();
  return result;
}

// Its id is one.
template <class T>
constexpr lockstep_leaf_type leaf_type(const char* id, const char* doc) {
  using Functions = LeafFunctions<T>;
  using Table = PortTable<typename T::PortsType>;
  lockstep_leaf_type type{};
  type.struct_size = sizeof(lockstep_leaf_type);
  type.kind = kind_of<T>();
  type.id = id;
  type.doc = doc;
  type.port_count = Table::kCount;
  type.ports = Table::kList.data();
  type.create = &Functions::create;
  type.destroy = &Functions::destroy;
  type.tick = &Functions::tick;
  type.flags = (T::kRealTime ? LOCKSTEP_REAL_TIME : 0) | (T::kWakes ? LOCKSTEP_WAKES : 0);
  if constexpr (Functions::kIsAction) add_optional_functions<T>(type);
  BehaviorOf<T>::add(type);
  DescribeOf<T>::add(type);
  if constexpr (std::is_base_of_v<ControlFunctions, T>) {
    type.min_children = T::kMinChildren;
    type.max_children = T::kMaxChildren;
  }
  return type;
}

}  // namespace detail

// Parts of a plugin, to be listed in LOCKSTEP_PLUGIN.

// A leaf, control node or decorator of class T: its XML tag, and one or two sentences about it.
template <class T>
constexpr lockstep_leaf_type leaf(const char* id, const char* doc) {
  if (!detail::is_id(id)) detail::error_id_must_be_letters_digits_underscores_and_dashes();
  return detail::leaf_type<T>(id, doc);
}

// The object that the leaves of a run share: one Context per run, made from a Run& or from nothing.
// Its leaves reach it with context<Context>().
template <class Context>
constexpr detail::RunContextPart run_context() {
  return {&detail::ContextHolder<Context>::create, &detail::ContextHolder<Context>::destroy};
}

// Called once before the first leaf, and once after the last. An exception from `Start` refuses to
// work, with its text as the reason.
template <void (*Start)()>
constexpr detail::InitPart init() {
  return {[](const lockstep_host* host, const lockstep_caller* id) noexcept {
    return detail::guarded(detail::Caller{host, id}, false, [] {
      Start();
      return true;
    });
  }};
}
template <void (*End)()>
constexpr detail::DeinitPart deinit() {
  return {[]() noexcept {
    try {
      End();
    } catch (...) {  // there is no one to report to
    }
  }};
}

}  // namespace sdk1
}  // namespace lockstep

// Defines the constant `table` as the plugin: name, version, one sentence, then its parts.
#define LOCKSTEP_PLUGIN_TABLE(table, ...)                                                        \
  static constexpr auto table##_parts = ::lockstep::detail::parts(__VA_ARGS__);                  \
  static constexpr auto table##_leaves = ::lockstep::detail::pointers(table##_parts);            \
  extern "C" {                                                                                   \
  constexpr ::lockstep_plugin table = ::lockstep::detail::plugin(table##_parts, table##_leaves); \
  }                                                                                              \
  [[maybe_unused]] static const bool table##_described =                                         \
      ::lockstep::detail::remember_describing(table##_leaves);                                   \
  static_assert(table.leaf_type_count > 0, "a plugin has at least one leaf")

// Exports the plugin from this shared object; once, outside of any namespace.
#define LOCKSTEP_PLUGIN(...) LOCKSTEP_PLUGIN_TABLE(lockstep_plugin_entry, __VA_ARGS__)
