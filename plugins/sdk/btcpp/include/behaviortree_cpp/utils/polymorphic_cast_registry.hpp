// Which classes derive from which, so that a std::shared_ptr to one is read as a std::shared_ptr to
// another: to a base always, to a derived class where the object is one.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <type_traits>
#include <typeindex>
#include <vector>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {

// From any thread. All types here are those of the pointers.
class PolymorphicCastRegistry {
 public:
  // Makes one type of another; an empty value: the object is none.
  using CastFunction = Any (*)(const Any& pointer);

  PolymorphicCastRegistry() = default;
  PolymorphicCastRegistry(const PolymorphicCastRegistry&) = delete;
  PolymorphicCastRegistry& operator=(const PolymorphicCastRegistry&) = delete;

  template <class Derived, class Base>
  void registerCast() {
    static_assert(std::is_base_of_v<Base, Derived>,
                  "registerPolymorphicCast<Derived, Base>: Derived does not derive from Base");
    static_assert(std::is_polymorphic_v<Base>,
                  "registerPolymorphicCast<Derived, Base>: Base needs a virtual function, such as "
                  "its destructor");
    using From = std::shared_ptr<Derived>;
    using To = std::shared_ptr<Base>;
    const Relation added{typeid(From), typeid(To),
                         [](const Any& it) { return Any(To(it.cast<From>())); },
                         [](const Any& it) {
                           const From found = std::dynamic_pointer_cast<Derived>(it.cast<To>());
                           return found == nullptr ? Any() : Any(found);
                         }};
    const std::unique_lock lock(mutex_);
    if (find(added.derived, added.base) == nullptr) relations_.push_back(added);
  }

  // Whether a value of one type may be read as another, up or down.
  [[nodiscard]] bool isConvertible(std::type_index from, std::type_index to) const {
    const std::shared_lock lock(mutex_);
    return from == to || !path(from, to).empty() || !path(to, from).empty();
  }
  // Whether each value of one type is one of the other.
  [[nodiscard]] bool canUpcast(std::type_index from, std::type_index to) const {
    const std::shared_lock lock(mutex_);
    return from == to || !path(from, to).empty();
  }
  [[nodiscard]] nonstd::expected<Any, std::string> tryCast(const Any& from,
                                                           std::type_index from_type,
                                                           std::type_index to_type) const {
    if (from_type == to_type) return from;
    const std::shared_lock lock(mutex_);
    Any value = from;
    if (const auto up = path(from_type, to_type); !up.empty()) {
      for (const Relation* it : up) value = it->up(value);
      return value;
    }
    auto down = path(to_type, from_type);
    if (down.empty()) {
      return nonstd::make_unexpected(StrCat("no cast from ", lockstep_detail::readable(from_type),
                                            " to ", lockstep_detail::readable(to_type),
                                            " is registered: registerPolymorphicCast"));
    }
    std::reverse(down.begin(), down.end());
    for (const Relation* it : down) {
      value = it->down(value);
      if (!value.empty()) continue;
      return nonstd::make_unexpected(StrCat("this ", lockstep_detail::readable(from_type),
                                            " points to no object of ",
                                            lockstep_detail::readable(to_type)));
    }
    return value;
  }
  // The types that were registered as its bases, themselves only.
  [[nodiscard]] std::set<std::type_index> getBaseTypes(std::type_index type) const {
    const std::shared_lock lock(mutex_);
    std::set<std::type_index> bases;
    for (const Relation& it : relations_) {
      if (it.derived == type) bases.insert(it.base);
    }
    return bases;
  }
  void clear() {
    const std::unique_lock lock(mutex_);
    relations_.clear();
  }

  // The types that a value of `to` may be made of, `to` itself not among them.
  [[nodiscard]] std::set<std::type_index> lockstep_sources(std::type_index to) const {
    const std::shared_lock lock(mutex_);
    std::set<std::type_index> all;
    for (const Relation& it : relations_) {
      for (const std::type_index type : {it.derived, it.base}) {
        if (type != to && (!path(type, to).empty() || !path(to, type).empty())) all.insert(type);
      }
    }
    return all;
  }

 private:
  struct Relation {
    std::type_index derived, base;
    CastFunction up, down;
  };
  using Path = std::vector<const Relation*>;

  const Relation* find(std::type_index derived, std::type_index base) const {
    for (const Relation& it : relations_) {
      if (it.derived == derived && it.base == base) return &it;
    }
    return nullptr;
  }
  // The steps up from a class to one of its bases, a shortest way; empty: there is none.
  Path path(std::type_index derived, std::type_index base) const {
    std::vector<Path> ways;  // each ends at another class
    const auto is_new = [&](std::type_index type) {
      return type != derived && std::none_of(ways.begin(), ways.end(), [&](const Path& way) {
               return way.back()->base == type;
             });
    };
    const auto extend = [&](std::type_index at, const Path& way) {
      for (const Relation& it : relations_) {
        if (it.derived != at || !is_new(it.base)) continue;
        ways.push_back(way);
        ways.back().push_back(&it);
      }
    };
    extend(derived, {});
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const Path way = ways[i];
      if (way.back()->base == base) return way;
      extend(way.back()->base, way);
    }
    return {};
  }

  mutable std::shared_mutex mutex_;
  std::vector<Relation> relations_;
};

template <class T>
nonstd::expected<T, std::string> Any::tryCastWithRegistry(
    const PolymorphicCastRegistry& registry) const {
  auto value = tryCast<T>();
  if constexpr (lockstep_detail::is_shared_pointer_v<T>) {
    if (value || empty()) return value;
    const auto made = registry.tryCast(*this, castedType(), typeid(T));
    if (!made) return nonstd::make_unexpected(made.error());
    return made->template tryCast<T>();
  } else {
    return value;
  }
}

namespace lockstep_detail {

// The casts of a Blackboard.
class BoardCasts {
 public:
  void setPolymorphicCastRegistry(std::shared_ptr<PolymorphicCastRegistry> registry) {
    lockstep_casts_ = std::move(registry);
  }
  // Null: none.
  [[nodiscard]] const PolymorphicCastRegistry* polymorphicCastRegistry() const {
    return lockstep_casts_.get();
  }
  // The value as a T, with a registered cast where it is a pointer to another class.
  template <class T>
  [[nodiscard]] nonstd::expected<T, std::string> tryCastWithPolymorphicFallback(
      const Any* value) const {
    if (lockstep_casts_ == nullptr) return value->template tryCast<T>();
    return value->template tryCastWithRegistry<T>(*lockstep_casts_);
  }

 private:
  std::shared_ptr<PolymorphicCastRegistry> lockstep_casts_;
};

}  // namespace lockstep_detail
}  // namespace BT
