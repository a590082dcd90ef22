// NAME.leaves.xml: what the leaves of a tree may do, as the user has written it. docs/verify.md has
// the reference. Names are as written here; leaves/models.h finds what they mean in a tree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/place.h"
#include "document/sources.h"

namespace lockstep::host {

// Of a number that the tree changes: from `least` to `most`; none: without end.
struct WholeRange {
  std::int64_t least = 0;
  std::optional<std::int64_t> most;

  friend bool operator==(const WholeRange&, const WholeRange&) = default;
};

// The results that an activation may have.
struct ResultSet {
  bool success = true, failure = true, skipped = false, fault = false;

  friend bool operator==(const ResultSet&, const ResultSet&) = default;
};

struct ProgressWay {
  enum class Kind : std::uint8_t { None, Cuts, Grid } kind = Kind::Cuts;
  std::uint32_t parts = 0;  // of a grid

  friend bool operator==(const ProgressWay&, const ProgressWay&) = default;
};

// How a fact of the world changes by itself.
enum class Changes : std::uint8_t { Never, Freely, Rises, Falls };
// When a leaf writes its outputs.
enum class Writes : std::uint8_t { OnSuccess, AtStart, InEachTick };

struct FactRow {
  std::string name;
  Changes changes = Changes::Freely;
  Place place = {};
};

// What is not said is not there.
struct LeafRow {
  std::string of, path;  // one of both: the id of a type, or a pattern for paths
  Place place = {};      // of that attribute
  std::optional<ResultSet> results = {};
  std::optional<WholeRange> ticks = {};
  std::optional<bool> ends = {};
  std::optional<ProgressWay> progress = {};
  std::optional<WholeRange> step = {};
  std::optional<bool> finishes_full = {};
  std::optional<WholeRange> held = {};  // 0..0: it stands still
  std::optional<Writes> writes = {};

  struct Named {
    std::string name;
    std::string text;
    Place place = {};
  };
  std::optional<Named> fact = {};
  std::vector<Named> sets = {};     // a fact, and "true" or "false"
  std::vector<Named> outputs = {};  // a port, and its values with '|' between
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
