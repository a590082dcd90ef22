// The properties of a tree while a search ticks it: what they look at is read from the engine,
// exactly as recordings have it, and all that they remember is some bytes of the state. They may
// also name facts of the models of leaves, {fact:charged}, which no run has.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "judge/measure/property_steps.h"
#include "language/property/property.h"
#include "leaves/model_leaf.h"
#include "run/live_moments.h"

namespace lockstep::host {

class PropertyWatch {
 public:
  // What ends with what is looked at.
  enum class End : std::uint8_t {
    OfRound,  // the tick goes on
    OfTick,
    OfRun,  // no tick comes any more
  };

  // Both must outlive this.
  PropertyWatch(const Tree& tree, std::span<const Property> properties);

  bool empty() const { return parts_.empty(); }
  std::size_t state_size() const { return state_size_; }
  void begin(std::byte* state) const;
  void before_tick(Ticker& ticker) { moments_.before_tick(ticker); }
  // After a tick, before its state is folded.
  void after_tick(std::byte* state, Ticker& ticker, std::span<const FactState> facts, End end);
  // In place of it: the tick violates nothing that was not violated before.
  void skip_tick() { violated_.clear(); }
  // Whether all that counts of a round is in the state: not if they compare what is known only at
  // the end of the tick.
  bool knows_rounds() const;

  // The properties that the last tick has violated, by their place.
  std::span<const std::size_t> violated() const { return violated_; }
  // Whether a property that is open would be violated if no tick came any more.
  bool owes(const std::byte* state, std::size_t property) const;

 private:
  // The part of a property. Its state has whether it is decided, the results of its comparisons
  // (which count while an entry has no value), and what the property itself keeps.
  struct Part {
    const Property* property;
    std::size_t first_byte;
    std::vector<SeenNode> seen;
    std::unique_ptr<bool[]> compared;
  };

  void compare(Part& part, std::byte* compared, const Moment& moment,
               std::span<const FactState> facts);
  PropertyVerdict step(Part& part, std::byte* own, const Moment& moment, bool ends_tick);

  const std::size_t first_fact_;  // of what is compared, behind the entries
  std::vector<Part> parts_;
  std::size_t state_size_ = 0;
  std::vector<std::size_t> violated_;
  LiveMoments moments_;
  MomentSteps steps_;
  std::string room_;
};

// The names of a tree, and behind its entries the facts of a leaf file.
PropertyNames names_with_facts(const Tree& tree, std::span<const FactRow> facts);
bool names_fact(const Property& property, const Tree& tree);

// The nodes whose statuses they or the scripts of the tree look at, with all above them.
std::vector<bool> nodes_of(std::span<const Property> properties, const Tree& tree);

}  // namespace lockstep::host
