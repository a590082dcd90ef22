// The functions of the contract for a leaf class: T(host, caller), start, tick, halt, pause,
// resume, progress, set_pace, save, restore. An exception becomes an error of the leaf.
#pragma once

#include <lockstep/leaf.h>

#include <exception>
#include <string_view>

namespace ros2 {

template <class T>
struct LeafFunctions {
  static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run) {
    try {
      return new T(*host, caller, run);
    } catch (const std::exception& error) {
      host->set_error(caller, error.what());
      return nullptr;
    }
  }
  static void destroy(void* leaf) { delete static_cast<T*>(leaf); }
  static void start(void* leaf) {
    call(leaf, 0, [](T& it) { return it.start(), 0; });
  }
  static lockstep_status tick(void* leaf) {
    return call(leaf, lockstep_status{LOCKSTEP_FAILURE}, [](T& it) { return it.tick(); });
  }
  static void halt(void* leaf) {
    call(leaf, 0, [](T& it) { return it.halt(), 0; });
  }
  static void pause(void* leaf) {
    call(leaf, 0, [](T& it) { return it.pause(), 0; });
  }
  static void resume(void* leaf) {
    call(leaf, 0, [](T& it) { return it.resume(), 0; });
  }
  static double progress(void* leaf) {
    return call(leaf, 0.0, [](T& it) { return it.progress(); });
  }
  static double set_pace(void* leaf, double factor) {
    return call(leaf, 1.0, [factor](T& it) { return it.set_pace(factor); });
  }
  static std::size_t save(void* leaf, void* bytes, std::size_t room) {
    return call(leaf, std::size_t{0}, [=](T& it) { return it.save(bytes, room); });
  }
  static lockstep_after_cut restore(void* leaf, const void* bytes, std::size_t size,
                                    const lockstep_cut* cut) {
    const std::string_view kept(static_cast<const char*>(bytes), size);
    return call(leaf, lockstep_after_cut{LOCKSTEP_STARTS_AGAIN},
                [=](T& it) { return it.restore(kept, *cut); });
  }

  static lockstep_leaf_type type(const char* id, const char* doc) {
    lockstep_leaf_type type{};
    type.struct_size = sizeof type;
    type.kind = LOCKSTEP_ACTION;
    type.id = id;
    type.doc = doc;
    type.create = create;
    type.destroy = destroy;
    type.start = start;
    type.start_unreset = start;
    type.tick = tick;
    type.halt = halt;
    type.flags = LOCKSTEP_REAL_TIME;
    return type;
  }

 private:
  template <class R, class Function>
  static R call(void* leaf, R otherwise, Function function) noexcept {
    T& it = *static_cast<T*>(leaf);
    try {
      return function(it);
    } catch (const std::exception& error) {
      it.fail(error.what());
      return otherwise;
    }
  }
};

}  // namespace ros2
