// NAME.leaves.xml: what the leaves of a tree may do, as the user has written it. docs/verify.md has
// the reference. Names are as written here; leaves/models.h finds what they mean in a tree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/core/after_cut.h"
#include "base/core/behavior.h"
#include "base/core/diagnostics.h"
#include "base/core/place.h"
#include "language/document/sources.h"

namespace lockstep::host {

// How a fact of the world changes by itself.
enum class Changes : std::uint8_t { Never, Freely, Rises, Falls };

struct FactRow {
  std::string name;
  Changes changes = Changes::Freely;
  std::optional<bool> starts = {};    // none: it is not known
  std::optional<double> chance = {};  // that it is true, where it may be both
  Place place = {};
};

struct LeafRow : Behavior {
  std::string of, path;  // one of both: the id of a type, or a pattern for paths
  Place place = {};      // of that attribute
  std::optional<Named> fact = {};
  std::vector<Named> sets = {};  // by its success: a fact, and "true" or "false"
  std::vector<Named> sets_on_failure = {};
  std::vector<AfterCut> after_cut = {};  // rising
};

// A finding that is as it should be.
struct AcceptedFinding {
  std::string finding, because;
  Place place = {};
};

struct LeafFile {
  Sources sources;
  std::optional<double> rate;
  bool tree_ends = true;
  std::vector<FactRow> facts;
  std::vector<LeafRow> leaves;
  std::vector<AcceptedFinding> accepted;
};

// Reports all errors; null if the text is no XML, or is of something else.
std::unique_ptr<LeafFile> read_leaf_file(std::string path, std::string text,
                                         Diagnostics& diagnostics);
// The same of the file with this name; null, with an error, if it cannot be read.
std::unique_ptr<LeafFile> load_leaf_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace lockstep::host
