// The boards of a run for those who use entries by their names: lockstep_boards.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/blackboard.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class BoardsOfRun;

}  // namespace lockstep::host

struct lockstep_board {
  lockstep::host::BoardsOfRun* run;
  std::uint32_t index;
};

namespace lockstep::host {

// Lives as long as the run, or as somebody has one of its boards.
class BoardsOfRun {
 public:
  // For a run with a lock.
  BoardsOfRun(const Tree& tree, Blackboard& blackboard);
  BoardsOfRun(const BoardsOfRun&) = delete;
  BoardsOfRun& operator=(const BoardsOfRun&) = delete;

  // The run is over.
  void end();
  // Another run begins with the same entries: what counted their writes begins again.
  void begin_again() { ++generation_; }

  // Null: there is none.
  lockstep_board* retain(std::uint32_t index);
  void release();

  EntriesLock& lock() { return *lock_; }
  // Under the lock. Null: the run is over.
  Blackboard* blackboard() { return blackboard_; }
  const Tree& tree() const { return *tree_; }
  std::uint32_t parent(std::uint32_t index) const { return parents_[index]; }
  std::uint64_t writes(const Entry& entry) const { return generation_ << 32 | entry.writes(); }
  // The home of an entry of the tree: `name` is the slot's own. Null if the tree has no such entry.
  const Home* home_of_slot(std::string_view name) const {
    const auto found = homes_.find(name.data());
    return found == homes_.end() ? nullptr : &found->second;
  }
  std::vector<lockstep_text>& texts() { return texts_; }

 private:
  ~BoardsOfRun() = default;

  const Tree* tree_;  // while blackboard_ is there
  Blackboard* blackboard_;
  const std::shared_ptr<EntriesLock> lock_;
  std::vector<lockstep_board> boards_;
  std::vector<std::uint32_t> parents_;
  std::unordered_map<const char*, Home> homes_;  // by the text of a slot's name
  std::uint64_t generation_ = 0;
  std::vector<lockstep_text> texts_;  // of the last list of texts that was read
  std::atomic<std::uint32_t> owners_ = 1;
};

struct EndBoards {
  void operator()(BoardsOfRun* boards) const;
};
using OwnBoards = std::unique_ptr<BoardsOfRun, EndBoards>;

// Null for a run without a lock.
OwnBoards make_boards(const Tree& tree, Blackboard& blackboard);

const lockstep_boards& boards_table();

}  // namespace lockstep::host
