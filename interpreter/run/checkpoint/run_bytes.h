// A saved run as bytes, for another process of the same program. The bytes of a node are as they
// are in memory, so they mean something only to the same tree in the same version.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/cut.h"
#include "engine/saved_run.h"

namespace lockstep::host {

struct Tree;

// Appends them, with what the leaves keep. Returns the size of their beginning, in which time alone
// changes something.
std::size_t append_bytes(const RunParts& run, const LeafBytes& leaves, std::string& to);

// False: they are not those of a run of such a tree. Then `into` and `leaves` mean nothing.
[[nodiscard]] bool read_bytes(std::string_view bytes, const Tree& tree, SavedRun& into,
                              LeafBytes& leaves);

// Of each node, for who does not have the tree. Empty: these are no such bytes.
std::vector<Activity> activities_in(std::string_view bytes);

// An entry that holds an object of a plugin, or may hold nothing else: objects have no bytes.
std::optional<std::string> entry_for_objects(const Tree& tree);
std::optional<std::string> entry_with_object(const RunParts& run, const Tree& tree);

}  // namespace lockstep::host
