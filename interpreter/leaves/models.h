// Models say what each leaf of a tree may do: a leaf file's rows found in the tree, then what
// plugins declare, and where nobody says anything the most general leaf that keeps the contract of
// lockstep/leaf.h and stands still while it is held. leaves/model_leaf.h does it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/core/after_cut.h"
#include "base/core/place.h"
#include "engine/tree.h"
#include "leaves/leaf_file.h"

namespace lockstep::host {

inline constexpr std::uint32_t kNoFact = 0xffffffff;
inline constexpr double kModelRate = 10;  // Hz, when nothing is said

struct LeafModel {
  NodeIndex node = 0;
  ResultSet results;
  bool can_run = true;
  std::int64_t least_ticks = 1;
  std::int64_t most_ticks = 0;  // 0: without end
  bool ends = true;
  // Its answers may count a tick later than it gives them, so it may get a tick more.
  bool answers_late = false;
  // The progress that it may have, rising from 0; 1 only if running with it is not the same as
  // having succeeded.
  std::vector<double> levels{0.0};
  // Of each level: the steps from 0 to it. One that only a property tells apart is as far as the
  // next one that is not; of a slowed leaf on a grid, as the part that it lies in.
  std::vector<std::int32_t> steps{0};
  std::int32_t goal = 1;       // as many steps: at 1, or behind all
  std::int32_t last_step = 0;  // of a level that not only a property tells apart
  bool has_progress = false;
  std::uint32_t parts = 0;  // of a grid; 0: the levels are cuts
  std::int64_t least_step = 0, most_step = 0;
  bool finishes_full = false;
  std::int64_t least_drift = 0, most_drift = 0;  // in each tick that is withheld
  std::uint32_t fact = kNoFact;
  struct Set {
    std::uint32_t fact;
    bool value;
    bool by_failure = false;  // else by a success

    friend bool operator==(const Set&, const Set&) = default;
  };
  std::vector<Set> sets;
  struct Output {
    std::uint32_t port;
    std::uint32_t slot;
    std::vector<Value> values;

    friend bool operator==(const Output&, const Output&) = default;
  };
  std::vector<Output> outputs;
  Writes writes = Writes::InAnyTick;
  std::vector<AfterCut> after_cut;  // that it may do; empty: see allow_cuts

  // The level of a leaf with this progress: the last one that it has reached.
  std::size_t level_of(double progress) const;
  // Whether a tick without its answer is one that it would not have otherwise.
  bool waits() const {
    return answers_late && (most_ticks != 0 || least_step > 0 || writes_first());
  }
  bool writes_first() const {
    return !outputs.empty() && (writes == Writes::AtStart || writes == Writes::InEachTick);
  }
  bool drifts() const { return least_drift != 0 || most_drift != 0; }
  friend bool operator==(const LeafModel&, const LeafModel&) = default;
};

struct Fact {
  std::string name;
  Changes changes;
  std::optional<bool> starts = {};  // none: it is not known
  // Of true and of false, whenever it may be both; all 0: nothing is known about chances.
  std::array<double, 2> chances = {};
  Place place = {};  // of its name
};

// What a model says of a leaf, for who names a statement.
enum class Assumption : std::uint8_t { Result, Ticks, Step, Finish, Held, Writes, Outputs, Fact };
inline constexpr std::size_t kAssumptions = 8;
// Where it comes from. Default: what verify assumes of every leaf.
struct SaidBy {
  enum class Who : std::uint8_t { Default, Plugin, Row } who = Who::Default;
  Place place = {};  // of the row
};

// A cut of the process: it ends without its last halts, and the next one goes on with the state of
// the run before the tick (docs/resume.md).
struct ProcessCuts {
  std::uint32_t most = 0;                      // in a run
  AfterCut otherwise = AfterCut::StartsAgain;  // of leaves of which nothing is said
};

struct LeafModels {
  std::vector<LeafModel> leaves;                       // of each Tree::leaves
  std::vector<std::array<SaidBy, kAssumptions>> said;  // of each Tree::leaves
  std::vector<Fact> facts;
  std::optional<double> rate;
  bool tree_ends = true;
  ProcessCuts cuts = {};
  std::vector<AcceptedFinding> accepted;
  std::vector<bool> entries;  // by slot: those whose values matter
  // The types whose leaves do as their plugin says, each with the statements that count.
  std::vector<std::string> declared;
  // Leaves: one of them may also return Skipped, lose progress while it is ticked, or write
  // otherwise than in its ticks.
  std::size_t unstated_results = 0, unstated_steps = 0, unstated_writes = 0;
  std::size_t slowed = 0;  // leaves that may be slower than their model says
};

// The progress and entries that somebody looks at beside the tree itself, and the values that
// somebody writes while it runs.
struct Observed {
  struct Progress {
    NodeIndex node;
    double constant;
  };
  std::vector<Progress> progress = {};                        // compared with constants
  std::vector<std::uint32_t> entries = {};                    // by slot
  std::vector<std::pair<std::uint32_t, Value>> written = {};  // the same
};

// A node of the tree with a mistake.
struct NodeProblem {
  NodeIndex node;
  std::string message, hint;
};

// Whether the statements of plugins about their leaves count.
enum class Declared : std::uint8_t { Counts, Ignored };

// Texts of values that leaves write, by "PORT" or "ID.PORT", where nothing else says which.
using GivenOutputs = std::map<std::string, std::string, std::less<>>;

// `file` may be null, and wins over what plugins declare. Errors in the file go to `diagnostics`;
// those of nodes, which need something that nothing says, to `problems`.
LeafModels make_models(const Tree& tree, const LeafFile* file, Diagnostics& diagnostics,
                       std::vector<NodeProblem>& problems, const Observed& observed = {},
                       Declared declared = Declared::Counts, const GivenOutputs& outputs = {});

// The process may be cut. What a leaf then does follows from its element and its type, unless a row
// of the leaf file says it.
void allow_cuts(const ProcessCuts& cuts, const Tree& tree, LeafModels& models);

// The entries that the engine itself reads or writes: in scripts, parameters and built-in nodes.
std::vector<bool> entries_of_engine(const Tree& tree);

// Whether a path is one that a pattern means, in which * stands for any part.
bool matches(std::string_view pattern, std::string_view path);

}  // namespace lockstep::host
