// The objects behind the handles of lockstep/runtime.h, and what its functions share. Only within
// embedding/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/system/own_process.h"
#include "embedding/lockstep/runtime.h"
#include "leaves/play/played_leaves.h"
#include "run/loading/load.h"
#include "run/loading/tree_identity.h"

namespace lockstep::host {

struct GrootTree;

// The texts of the nodes of a tree, and the types of its entries, as strings that end in a NUL.
struct TreeTexts {
  explicit TreeTexts(const Tree& tree);
  std::vector<std::string> paths, names, ids, types;
};

// The plugins and the tree of a project. Runs share it, on any threads.
class Program {
 public:
  // `leaves` are those to which the tree refers, or null.
  Program(std::shared_ptr<const PlayedLeaves> leaves, TreeIdentity made_from, Runnable loaded,
          std::string from, std::shared_ptr<const GrootTree> shown)
      : played(std::move(leaves)),
        identity(std::move(made_from)),
        runnable(std::move(loaded)),
        file(std::move(from)),
        groot(std::move(shown)) {}

  const std::shared_ptr<const PlayedLeaves> played;
  const TreeIdentity identity;  // for checkpoints
  const Runnable runnable;
  const std::string file;                        // of the tree, as the program named it
  const std::shared_ptr<const GrootTree> groot;  // null: Groot2 is not to see it
  // Made when somebody asks for the first time.
  const TreeTexts& texts() const {
    std::call_once(has_texts_, [this] { texts_.emplace(runnable.tree); });
    return *texts_;
  }

 private:
  mutable std::once_flag has_texts_;
  mutable std::optional<TreeTexts> texts_;
};

}  // namespace lockstep::host

struct lockstep_project {
  lockstep::host::LoadOptions options;
  std::shared_ptr<lockstep::host::PluginSet> plugins =
      std::make_shared<lockstep::host::PluginSet>();
  lockstep::host::Diagnostics diagnostics;
  std::shared_ptr<const lockstep::host::Program> program;  // null until it is loaded
  bool load_tried = false;
  bool shows_groot = false;
  std::shared_ptr<lockstep::host::PlayedLeaves> played;  // null: leaves are those of plugins
  lockstep::host::LeafScripts scripts;                   // of those
  lockstep::host::OwnProcess process;                    // that has loaded it, or made it
};

namespace lockstep::host::embedding {

// Keeps the reason for lockstep_last_error, of a length that anybody can show. Returns false.
bool fail(std::string_view reason) noexcept;
// Whether a text that the program passes in is one: neither NULL nor anything but UTF-8. `what` is
// "the key".
bool is_text(std::string_view what, const char* text) noexcept;
bool is_text(std::string_view what, const char* text, std::size_t length) noexcept;
// The slot of an entry that a node of the tree uses; else there is an error.
std::optional<std::uint32_t> find_slot(const Tree& tree, const char* key);
// Nothing is wrong with this call.
void forget_error() noexcept;

// The boundary: what `work` throws becomes an error, and the result is T().
template <class Work>
auto shielded(Work&& work) noexcept -> decltype(work()) {
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

// Makes a call that may fail; the error of an earlier one is over.
template <class Work>
auto guarded(Work&& work) noexcept -> decltype(work()) {
  forget_error();
  return shielded(work);
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

}  // namespace lockstep::host::embedding
