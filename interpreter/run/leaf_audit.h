// Where leaves do what their leaf model does not allow: then what verify has proved does not hold
// for them. Of a run that goes on, or of a recording.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "language/document/sources.h"
#include "leaves/model_leaf.h"
#include "run/leaf_calls.h"

namespace lockstep::host {

struct LeafBreach {
  NodeIndex node = 0;   // of the shape
  std::string message;  // "took 7 ticks, the leaf model allows 2 to 5 (door.leaves.xml:4)"
};

class LeafAudit {
 public:
  // All must outlive this. `sources` has the rows of the leaf model; null: there are none.
  LeafAudit(const Shape& shape, const Tree& tree, const LeafModels& models, const Sources* sources);

  // What the Moments of a run must have.
  AskedOfRun asked() const;
  // Before the first tick of a run, and before the first after a cut: what leaves did that run
  // already is not known. Their next result may be one that they have by the cut.
  void begin(const Moment& before);
  // Before a tick of a run, so that what came into an entry from outside is no leaf's.
  void before_tick(const Moment& moment);
  // Before after_tick: a leaf has failed as a program, and the run goes on. Its failure, in this
  // tick or later, is not its own.
  void note_fault(NodeIndex node);
  // After a tick; `set`: of a recording, the entries that were written since the tick before.
  // Valid until the next call. Does not allocate, but for what it finds.
  std::span<const LeafBreach> after_tick(const Moment& moment,
                                         std::span<const std::uint32_t> set = {});

 private:
  struct Output {
    const LeafModel::Output* of;
    std::uint32_t entry;                          // of the shape
    std::vector<std::int64_t> whole = {};         // its values, rising, if all are whole numbers
    std::optional<std::size_t> last = {};         // which of its values the entry had last
    bool has_changed = false, is_allowed = true;  // in this tick
  };
  struct Leaf {
    NodeIndex node;  // of the shape
    const LeafNode* leaf;
    const LeafModel* model;
    std::size_t number;  // in the tree
    std::vector<LevelReach> in_a_tick, while_held;
    std::vector<Output> outputs = {};
    std::int64_t ticks = 0;                     // of this activation
    std::int64_t open_ticks = 0;                // of them: those whose answers may not be there
    bool knows_begin = true;                    // of it
    bool is_overdue = false, was_late = false;  // it must have ended; that was reported
    bool is_cut = false;                        // its next result may be by a cut
    bool has_fault = false;                     // see note_fault
    bool has_just_begun = false;                // this tick may have its first answer
    bool was_held = false;                      // after the tick before
    bool was_ticked = false;                    // once, in the tick before, and it runs since
    double progress = 0;  // when that hold began, or at the start of that tick
  };
  struct WrittenEntry {
    std::vector<NodeIndex> writers = {};  // of the shape
    std::uint32_t writes = 0;             // after the tick before
    bool is_set = false;                  // since then, from outside
  };
  struct KnownFact {
    FactState is = FactState::Unknown;
    std::optional<bool> read = {};  // in this tick
    NodeIndex reader = 0;
    bool set_true = false, set_false = false;  // in this tick
  };

  bool is_called(const Moment& moment, NodeIndex node) const;
  std::uint32_t writes_of(const Moment& moment, std::uint32_t entry) const;
  void look(const Moment& moment, std::span<const LeafCalls::Call> calls, Leaf& leaf);
  void look_at_progress(double progress, Leaf& leaf);
  void look_at_outputs(const Moment& moment, std::span<const LeafCalls::Call> calls, Leaf& leaf);
  void compare(const Moment& moment, const Leaf& leaf, Output& output) const;
  void count(Leaf& leaf, Status status, bool is_alone);
  void read(const Leaf& leaf, Status status);
  void take_sets();
  void end_facts();
  void add(const Leaf& leaf, Assumption what, std::string message);
  std::string place(const Leaf& leaf, Assumption what) const;

  const Shape& shape_;
  const Tree& tree_;
  const LeafModels& models_;
  const Sources* const sources_;
  LeafCalls calls_;
  std::uint64_t next_ = 0;        // tick
  bool knows_before_ = false;     // the Moment before is that of the tick before
  std::vector<Activity> before_;  // after it
  std::vector<WrittenEntry> entries_;
  std::vector<Leaf> leaves_;
  std::vector<KnownFact> facts_;
  std::vector<LeafBreach> found_;
};

}  // namespace lockstep::host
