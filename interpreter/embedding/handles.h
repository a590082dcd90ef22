// The objects behind the handles of lockstep/runtime.h, and what its functions share. Only within
// embedding/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "embedding/lockstep/runtime.h"
#include "loading/load.h"

namespace lockstep {

// What a project has loaded. Runs share it.
struct Program {
  Runnable runnable;
  // Of the nodes, and the types of the entries, as strings that end in a NUL.
  std::vector<std::string> paths, names, ids, types;
};

}  // namespace lockstep

struct lockstep_project {
  lockstep::LoadOptions options;
  std::shared_ptr<lockstep::PluginSet> plugins = std::make_shared<lockstep::PluginSet>();
  lockstep::Diagnostics diagnostics;
  std::shared_ptr<const lockstep::Program> program;  // null until it is loaded
  bool load_tried = false;
};

namespace lockstep::embedding {

// Keeps the reason for lockstep_last_error. Returns false.
bool fail(std::string_view reason) noexcept;

// The boundary: what `work` throws becomes an error, and the result is T().
template <class Work>
auto guarded(Work&& work) noexcept -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    fail("there is no memory left");
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("an unknown exception");
  }
  return decltype(work())();
}

// The part of a struct of the program that its struct_size covers; the rest is 0.
template <class Struct>
Struct read_struct(const Struct* given) {
  Struct whole{};
  if (given != nullptr) {
    std::memcpy(&whole, given, std::min<std::size_t>(given->struct_size, sizeof(Struct)));
  }
  return whole;
}

template <class Struct>
bool write_struct(Struct whole, Struct* target) {
  if (target == nullptr) return fail("there is no struct to write to");
  if (target->struct_size < sizeof(target->struct_size)) return fail("struct_size is not set");
  whole.struct_size = target->struct_size;
  std::memcpy(target, &whole, std::min<std::size_t>(target->struct_size, sizeof(Struct)));
  return true;
}

}  // namespace lockstep::embedding
