// The answers of a tick, joined from what each child of the root may do by itself. Where the root
// is a parallel of children that share nothing, what one of them does in a tick depends on its own
// answers only. So each is ticked with all of its answers, while the others stand still. Of the
// combinations of these that lead to one state, one is ticked. Example: 40 Sequences of two leaves,
// of which 20 are in each leaf, have 53,361 combinations, and come to 861 states.
//
// No cycle is lost by that. A child that does something again and again for ever runs in each of
// these ticks, since it gets none once it has completed. So all that are equal to it can do the
// same from the first tick on, and if they do, one combination leads to each state. That needs
// outcomes that are no twins: a child keeps something else after each of them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/node_context.h"
#include "verify/symmetry.h"
#include "verify/tick_answers.h"

namespace lockstep::host {

class JointAnswers {
 public:
  // A child of the root.
  struct Child {
    EqualChildren::Place first, end;
    NodeIndex like;  // the first child that is equal to it
  };
  // A tick in which the others stood still.
  struct ChildTick {
    std::vector<LeafAnswer> answers;              // of its leaves
    Status status;                                // of the child
    std::optional<std::vector<std::byte>> after;  // what it keeps; none: the run has ended
    std::vector<std::byte> marks;                 // of its leaves: what a label has of them
  };
  // All ticks of a child. None: they are not as those of a child by itself, or are too many.
  using TicksOf = std::function<std::optional<std::vector<ChildTick>>(const Child& child)>;

  // All must outlive this. Used in states with more than so many combinations.
  JointAnswers(const Tree& tree, const LeafModels& models, const Symmetry& symmetry,
               std::uint64_t few_ticks);

  // Whether it can be used in some state.
  bool is_empty() const { return children_.empty(); }

  // From this state on. False: all combinations have to be tried.
  bool begin_state(const RunState& run, const std::vector<LeafState>& leaves,
                   const NodeContext& context, const TicksOf& ticks_of);
  // What a child keeps. `words` are RunState::bytes, with children numbered from their node.
  static std::vector<std::byte> kept(const Child& child, const std::vector<Activity>& activity,
                                     std::span<const std::uint64_t> words,
                                     const std::vector<LeafState>& leaves);

  // Those of the tick. False: it was the last one.
  std::span<const LeafAnswer> answers() const { return answers_; }
  bool next();

 private:
  using Counts = std::vector<std::uint16_t>;
  using Word = std::vector<LeafAnswer>;
  struct Outcome {
    Status status;
    std::optional<std::uint32_t> after;  // which of `after_`
    std::vector<std::byte> marks;
    std::vector<Word> words;  // that lead to it
  };
  // Equal children in one state.
  struct Group {
    std::vector<std::uint32_t> children;
    std::vector<std::byte> kept;
    std::vector<Outcome> outcomes = {};
    std::size_t first_outcome = 0;  // of all groups
  };
  // How many children have each of the first outcomes, and where that leads.
  struct Joined {
    Counts outcomes, after;
    std::uint32_t left = 0;  // children of the group without an outcome
    StatusCounts statuses = {};
    std::optional<std::uint64_t> end = {};  // the run ends: what NodeKind::sure_to_end returns
    std::uint32_t ended_by = 0;             // the first group with which it does
  };
  // A combination in which some child has this outcome by this word.
  struct Example {
    Joined joined;
    std::size_t outcome, word;
  };

  void make_groups(const RunState& run, const std::vector<LeafState>& leaves);
  bool find_outcomes(const TicksOf& ticks_of);
  bool has_twins() const;
  std::uint32_t number_of(NodeIndex like, const std::vector<std::byte>& kept);
  bool are_few() const;
  bool join(const NodeContext& context);
  Joined nobody() const { return {.outcomes = {}, .after = Counts(after_.size())}; }
  template <class Take>
  bool add(const NodeContext& context, const Joined& before, Take take) const;
  void find_end(const NodeContext& context, std::uint32_t group, Joined& joined) const;
  void add_examples();
  void put(const Joined& joined, std::size_t outcome, std::size_t word);

  const Tree& tree_;
  const Symmetry& symmetry_;
  const std::uint64_t few_ticks_;
  std::vector<Child> children_;
  std::vector<Group> groups_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> outcomes_;  // a group, and which of it
  // What a child keeps after a tick, and which of them that are equal.
  std::vector<std::pair<NodeIndex, std::vector<std::byte>>> after_;
  std::vector<Joined> all_;        // one for each state, and some for each end
  std::vector<Example> examples_;  // behind them, so that each word is in one
  std::size_t at_ = 0;             // in those
  std::vector<LeafAnswer> answers_;
};

}  // namespace lockstep::host
