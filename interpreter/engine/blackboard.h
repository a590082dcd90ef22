// The entries that the nodes of one run share: a slot per key, resolved when the tree was compiled,
// and those whose names are known only while it runs.
#pragma once

#include <memory>
#include <vector>

#include "base/blackboard/entry.h"
#include "engine/entries_lock.h"
#include "engine/named_entries.h"
#include "engine/tree.h"

namespace lockstep::host {

struct Blackboard {
  explicit Blackboard(const Tree& tree);
  void reset(const Tree& tree);

  std::vector<Entry> entries;
  NamedEntries names;
  // Null: one thread uses the entries (Tree::shares_entries).
  const std::shared_ptr<EntriesLock> lock;
};

}  // namespace lockstep::host
