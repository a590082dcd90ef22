// The blackboards that Groot2 asks for: one for each subtree. What Groot2 has no picture for is in
// them too: the progress of nodes, who is held, barriers and deltas.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/json/json.h"
#include "groot/board_keys.h"
#include "record/live/snapshot.h"
#include "trace/shape.h"

namespace lockstep::host {

class GrootBoards {
 public:
  GrootBoards(Shape shape, std::vector<GrootBoardKeys> boards);
  GrootBoards(const GrootBoards&) = delete;
  GrootBoards& operator=(const GrootBoards&) = delete;

  // The boards of some subtrees, "A;B", as MessagePack: {"A":{"key":value}}.
  std::string dump(std::string_view names, const Snapshot& snapshot) const;

 private:
  enum class What : std::uint8_t { Progress, Held, Limit };
  // A number of a node that is shown as an entry.
  struct Shown {
    std::string key;
    NodeIndex node;
    What what;
  };
  void show_synchronized(NodeIndex node);
  void show(NodeIndex node, std::string_view prefix, What what);
  Json shown(const Shown& it, const Snapshot& snapshot) const;
  Json board(std::size_t number, const Snapshot& snapshot) const;

  const Shape shape_;
  std::vector<GrootBoardKeys> boards_;
  std::vector<std::vector<Shown>> shown_;  // of each board
  std::map<std::string_view, std::size_t> by_name_;
  std::map<NodeIndex, std::size_t> by_node_;
};

}  // namespace lockstep::host
