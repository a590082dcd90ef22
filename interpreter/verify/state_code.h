// The state of a run as bytes that can be compared: what is active of a folded run, what its leaves
// keep, the facts, what properties remember, the entries that the tree reads, and parameters that
// were read from entries which say something else now.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/saved_run.h"
#include "engine/ticker.h"
#include "leaves/model_leaf.h"
#include "verify/child_order.h"
#include "verify/read_holds.h"

namespace lockstep::host {

using StateBytes = std::vector<std::byte>;

// What an active node of Tree::bound has read.
struct ReadValues {
  std::uint32_t place;
  std::vector<Value> values;
};

class StateCode {
 public:
  // `fresh` is a run before its first tick. All must outlive this.
  // `watched`: the nodes whose statuses count even where the tree does not look at them.
  StateCode(const Tree& tree, const LeafModels& models, const SavedRun& fresh,
            std::vector<bool> watched, const Symmetry& symmetry);

  // Notes what a fold would forget: those statuses, and which entries were written since they were
  // read.
  void before_fold(Ticker& ticker);

  // Encodes a run that is folded, with equal children in one order or as they are.
  enum class Children : std::uint8_t { Sorted, AsTheyAre };
  void encode(const Ticker& ticker, ModelLeaves& leaves, std::span<const std::byte> properties,
              Children children, StateBytes& into);
  // How often the process was cut in the run that is encoded, or was decoded.
  std::uint8_t cuts() const { return cuts_; }
  void set_cuts(std::uint8_t cuts) { cuts_ = cuts; }
  // The same of an encoded one.
  static std::uint8_t cuts_of(std::span<const std::byte> state) {
    return std::to_integer<std::uint8_t>(state.back());
  }
  static void set_cuts_of(StateBytes& state, std::uint8_t cuts) { state.back() = std::byte{cuts}; }
  // Adds the entries only, of any run.
  void add_entries(const Ticker& ticker, StateBytes& to) const;
  // What is encoded, without the properties and the entries.
  const KeptState& kept() const { return kept_; }
  // The node that was in each place before it was encoded; empty if none has moved.
  std::span<const NodeIndex> origins() const { return order_.origins(); }
  // The state in which each node is at one of these places.
  void move(std::span<const std::byte> from, std::span<const NodeIndex> places, StateBytes& into);
  void decode(std::span<const std::byte> from, SavedRun& run, std::vector<LeafState>& leaves,
              std::vector<FactState>& facts, std::span<std::byte> properties,
              std::vector<ReadValues>& values);

 private:
  class Writer;
  class ByteReader;
  static void write(const KeptState& state, Writer& writer);
  void read(ByteReader& reader, KeptState& state) const;
  void write(const std::vector<ReadValues>& all, Writer& writer) const;
  void read(ByteReader& reader, std::vector<ReadValues>& all) const;

  const Tree& tree_;
  const SavedRun& fresh_;
  std::vector<std::uint32_t> entries_;  // the slots that are in the state
  const ReadHolds holds_;
  const bool counts_cuts_;
  std::uint8_t cuts_ = 0;
  std::vector<NodeIndex> watched_;
  std::vector<Activity> seen_;    // of those, before the fold
  std::vector<ReadValues> read_;  // before the fold, where entries say something else
  ChildOrder order_;
  KeptState kept_;  // as it is encoded
};

}  // namespace lockstep::host
