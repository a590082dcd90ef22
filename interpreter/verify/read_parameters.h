// The parameters that the engine has read from entries, kept from one tick of a search for others
// that begin with the same entries, so that they are not read and checked in each of them.
#pragma once

#include <vector>

#include "engine/saved_run.h"
#include "engine/ticker.h"

namespace lockstep::host {

class ReadParameters {
 public:
  // `fresh` is a run before its first tick. Both must outlive this.
  ReadParameters(const Tree& tree, const SavedRun& fresh);

  // After a tick from this run, before it is folded.
  void learn(const SavedRun& from, Ticker& ticker);
  // Puts what is known for its entries into a run, else what a fresh one has.
  void give(SavedRun& run);

 private:
  bool are_known(const std::vector<Entry>& entries) const;

  const SavedRun& fresh_;
  std::vector<std::uint32_t> slots_;  // of the entries that give parameters
  std::vector<Entry> entries_;        // of those: for which the parameters are
  BoundParameters::State known_;
  std::size_t count_ = 0;  // of the nodes whose parameters are known
  std::size_t given_ = 0;  // of those, how many the run has
};

}  // namespace lockstep::host
