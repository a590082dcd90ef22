// What the scripts of a tree read of the run (Tree::readings), as it is before each tick. They are
// read once, before the groups and the root are ticked, so that all scripts of a tick see one
// snapshot, as synchronized nodes do.
#pragma once

#include <span>
#include <vector>

#include "base/blackboard/entry.h"
#include "engine/tree.h"

namespace lockstep::host {

class NodeContext;

class Readings {
 public:
  explicit Readings(const Tree& tree);

  bool empty() const { return values_.empty(); }
  // Reads them for the tick that begins. Does not allocate.
  void read(NodeContext& context);
  // Their values, which no script assigns. They stay where they are.
  Entry* at(std::uint32_t number) { return &values_[number]; }

 private:
  Value& value(std::size_t number) { return values_[number].to_write(); }
  void set_text(std::size_t number, std::string_view text);

  const Tree& tree_;
  std::vector<Entry> values_;  // of each Tree::readings
  std::string path_;
};

}  // namespace lockstep::host
