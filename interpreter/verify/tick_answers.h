// The answers of the leaves in one tick: all combinations in turn, or given ones. Of equal children
// in equal states, each gives the answers of the one before it or some that come later: from its
// first other answer on, where they are compared as words are. That loses nothing: children in
// equal states are asked the same as long as they answer the same, whatever others do. So in any
// tick they can change places until their answers are in order, first those that are farthest
// inside, and it leads to the same state but for who is who.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/run_state.h"
#include "leaves/model_leaf.h"
#include "verify/symmetry.h"

namespace lockstep::host {

struct LeafAnswer {
  std::uint32_t asker, value;

  friend bool operator==(const LeafAnswer&, const LeafAnswer&) = default;
};

class TickAnswers final : public Answers {
 public:
  // That had more than one answer.
  struct Question {
    std::uint32_t value, count, asker;
    std::uint32_t was_tied = 0;       // a bit for each child that the asker is in
    const double* chances = nullptr;  // of the answers; null: there are none
  };
  // `askers`: leaves and facts. Both must outlive this.
  TickAnswers(const Tree& tree, const Symmetry& symmetry, std::size_t askers);

  // All combinations of a state, from the first on.
  void begin_state(const RunState& run, const std::vector<LeafState>& leaves);
  // In place of combinations: those of each asker in their order.
  void give(std::span<const LeafAnswer> answers);

  // All combinations of a state, of the leaves from `first` until `end`. The others give what
  // `others` says.
  using OfOthers = std::function<std::uint32_t(std::uint32_t count, std::uint32_t asker)>;
  void ask_only(std::uint32_t first, std::uint32_t end, OfOthers others);

  // Before each tick.
  void begin();
  // How many of the first answers of the tick before it come again.
  std::size_t same_as_before() const { return digits_.empty() ? 0 : digits_.size() - 1; }
  // After it. False: it was the last combination.
  bool next();
  // Within it: from here on those since the first of these are given again and again.
  void repeat_from(std::size_t first);
  std::uint32_t choose(std::uint32_t count, std::uint32_t asker) override;
  std::uint32_t draw(std::span<const double> chances, std::uint32_t asker) override;
  // Asked before a new answer, where `looks`: whether what follows is known, from another tick.
  using IsKnown = std::function<bool(std::uint32_t asker)>;
  void set_is_known(IsKnown is_known) { is_known_before_ = std::move(is_known); }
  void look_at_points(bool looks) { looks_ = looks; }
  // It was: then the rest of the tick has had the first answers.
  bool is_known() const { return is_known_; }

  bool are_given() const { return is_given_; }
  std::size_t count() const { return at_; }
  // Visits what says which answers a child may still give, in this tick: those of the equal one.
  template <class Visit>
  void for_each_tie(Visit visit) const {
    for (const std::uint32_t it : with_equals_) {
      const Child& child = children_[it];
      visit(child.is_tied);
      if (!child.follows || !child.is_tied) continue;
      const std::vector<std::uint32_t>& before = children_[it - 1].answers;
      visit(before.size() - std::min(before.size(), child.answers.size()));
      for (std::size_t i = child.answers.size(); i < before.size(); ++i) visit(before[i]);
    }
  }

  // Those of the tick, in their order.
  std::span<const Question> questions() const { return std::span(digits_).first(at_); }
  // After `next`: of the questions of the tick before it, these come again. The last one has
  // another answer.
  std::size_t questions_left() const { return digits_.size(); }
  // What the tick has asked that had more than one answer.
  std::vector<LeafAnswer> asked() const;
  // The children that are in a state equal to that of the one before them.
  struct EqualChild {
    std::size_t of, place;  // in Symmetry::classes
  };
  std::span<const EqualChild> equal_children() const { return equal_children_; }

 private:
  // A child that is equal to one beside it.
  struct Child {
    bool has_equal = false;  // in an equal state, too
    bool follows = false;    // that one is before it
    bool is_tied = false;    // it has answered as that one in this tick, as far as it has
    std::vector<std::uint32_t> answers = {};
  };
  bool are_equal(const EqualChildren& it, std::size_t place, const RunState& run,
                 const std::vector<LeafState>& leaves) const;
  // A child gives what the one before it leaves it.
  bool has_ties() const { return !with_equals_.empty() && !is_given_ && of_others_ == nullptr; }
  std::uint32_t least(std::uint32_t asker) const;
  std::uint32_t repeat(std::uint32_t asker);
  void note(Question& digit);
  void undo(const Question& digit);
  std::uint32_t given(std::uint32_t asker, std::uint32_t count);

  const Tree& tree_;
  const Symmetry& symmetry_;
  std::vector<Child> children_;                          // of all classes
  std::vector<std::vector<std::uint32_t>> children_of_;  // of each asker: which it is in
  std::vector<std::uint32_t> with_equals_;               // those that have one in an equal state
  std::vector<EqualChild> equal_children_;
  std::vector<std::uint64_t> words_;
  std::vector<Question> digits_;
  std::size_t at_ = 0;
  std::size_t repeats_from_ = 0;
  bool is_given_ = false, repeats_ = false;
  std::uint32_t first_asked_ = 0, end_asked_ = 0;
  OfOthers of_others_;  // null: all are asked
  bool looks_ = false, is_known_ = false;
  IsKnown is_known_before_;
  std::vector<LeafAnswer> repeated_;
  std::vector<std::vector<std::uint32_t>> given_;  // of each asker
  std::vector<std::size_t> next_given_;            // likewise: its next one
};

}  // namespace lockstep::host
