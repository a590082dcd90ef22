// The answers of the leaves in one tick: all combinations in turn, or given ones. Equal leaves in
// equal states give theirs in rising order, also where each is in an equal child that has no other:
// with two answers exchanged, the tick leads to the same state, but for who is who.
#pragma once

#include <limits>
#include <span>
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
  // `askers`: leaves and facts.
  TickAnswers(const Symmetry& symmetry, std::size_t askers);

  // All combinations of a state, from the first on.
  void begin_state(const RunState& run, const std::vector<LeafState>& leaves);
  // In place of combinations: those of each asker in their order.
  void give(std::span<const LeafAnswer> answers);

  // Before each tick.
  void begin();
  // After it. False: it was the last combination.
  bool next();
  std::uint32_t choose(std::uint32_t count, std::uint32_t asker) override;

  // What the tick has asked that had more than one answer.
  std::vector<LeafAnswer> asked() const;
  // The leaf before this one among those that are equal and in equal states; kNone: none.
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t equal_before(std::uint32_t leaf) const { return equal_before_[leaf]; }

 private:
  struct Digit {
    std::uint32_t value, count, asker;
  };
  void forget_first();
  std::uint32_t least(std::uint32_t asker) const;
  std::uint32_t given(std::uint32_t asker);

  struct Neighbors {
    EqualChildren::Place before, here;
    std::uint32_t nodes, words;  // of each
  };
  static bool are_equal(const Neighbors& it, const RunState& run);
  std::vector<Neighbors> neighbors_;         // equal children with one leaf each
  std::vector<std::uint32_t> equal_before_;  // of each asker
  std::vector<std::uint32_t> first_;         // of each asker: its first answer in this tick
  bool has_equal_ = false;
  std::vector<Digit> digits_;
  std::size_t at_ = 0;
  bool is_given_ = false;
  std::vector<LeafAnswer> given_;
  std::vector<bool> is_used_;  // of those
};

}  // namespace lockstep::host
