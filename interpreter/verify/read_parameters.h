// The parameters that the engine has read from entries. They are kept from one tick of a search for
// others that begin with the same entries, so that they are not read and checked in each of them.
#pragma once

#include <span>
#include <vector>

#include "engine/saved_run.h"
#include "engine/ticker.h"
#include "verify/state_code.h"

namespace lockstep::host {

class ReadParameters {
 public:
  // `fresh` is a run before its first tick. Both must outlive this.
  ReadParameters(const Tree& tree, const SavedRun& fresh);

  // After a tick from this run, before it is folded.
  void learn(const SavedRun& from, Ticker& ticker);
  // Puts into a run what is known for its entries, and what its active nodes have read: `values`
  // where an entry says something else now. The ticker is in any state after it.
  void give(SavedRun& run, std::span<const ReadValues> values, Ticker& ticker);

 private:
  void give_known(SavedRun& run);
  bool are_known(const std::vector<Entry>& entries) const;

  static constexpr std::size_t kOthers = static_cast<std::size_t>(-1);

  const Tree& tree_;
  const SavedRun& fresh_;
  std::vector<std::uint32_t> slots_;  // of the entries that give parameters
  std::vector<Entry> entries_;        // of those: for which the parameters are
  BoundParameters::State known_;
  std::size_t count_ = 0;  // of the nodes whose parameters are known
  std::size_t given_ = 0;  // of those, how many the run has; kOthers: it has others
};

}  // namespace lockstep::host
