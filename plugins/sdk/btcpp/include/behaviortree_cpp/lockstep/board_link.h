// The entries of a tree that runs, for BT::Blackboard: a board of the host.
#pragma once

#include <lockstep/leaf.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "behaviortree_cpp/lockstep/entry_value.h"

namespace BT {
class Blackboard;
}

namespace BT::lockstep_detail {

// A board that this has.
class BoardHandle {
 public:
  BoardHandle() = default;
  BoardHandle(const lockstep_boards& table, lockstep_board* board) : table_(&table), it_(board) {}
  BoardHandle(BoardHandle&& other) noexcept
      : table_(other.table_), it_(std::exchange(other.it_, nullptr)) {}
  BoardHandle& operator=(BoardHandle&& other) noexcept {
    std::swap(table_, other.table_);
    std::swap(it_, other.it_);
    return *this;
  }
  ~BoardHandle() {
    if (it_ != nullptr) table_->release(it_);
  }

  const lockstep_boards* operator->() const { return table_; }
  lockstep_board* get() const { return it_; }
  explicit operator bool() const { return it_ != nullptr; }
  BoardHandle at(std::uint32_t index) const { return {*table_, table_->at(it_, index)}; }

 private:
  const lockstep_boards* table_ = nullptr;
  lockstep_board* it_ = nullptr;
};

// The boards of one run, as this shared object sees them.
struct BoardFamily {
  explicit BoardFamily(BoardHandle main) : root(std::move(main)) {}

  const BoardHandle root;
  std::mutex mutex;
  std::map<std::uint32_t, std::weak_ptr<Blackboard>> boards;  // by their index; under the mutex

  // Nodes of one run find the same one.
  [[gnu::visibility("hidden")]] static std::shared_ptr<BoardFamily> of(BoardHandle root);
};

// A key, where it is at home.
struct HomeKey {
  std::uint32_t board;
  StringView key;
};

class BoardLink {
 public:
  BoardLink(std::shared_ptr<BoardFamily> family, BoardHandle board)
      : family_(std::move(family)), board_(std::move(board)) {}

  const std::shared_ptr<BoardFamily>& family() const { return family_; }
  std::uint32_t index() const { return board_->index(board_.get()); }
  std::uint32_t parent() const { return board_->parent(board_.get()); }
  HomeKey home(StringView key) const {
    const char* name = nullptr;
    std::size_t length = 0;
    const std::uint32_t board = board_->home(board_.get(), key.data(), key.size(), &name, &length);
    return {board, {name, length}};
  }
  // Under the lock. False: there is no such entry.
  bool read(const std::string& key, lockstep_entry_value& value) const {
    return board_->read(board_.get(), key.data(), key.size(), &value);
  }
  bool write(const std::string& key, const EntryValue& value) const {
    return board_->write(board_.get(), key.data(), key.size(), &value.it);
  }
  void unset(const std::string& key) const { board_->unset(board_.get(), key.data(), key.size()); }
  std::vector<std::string> keys() const {
    std::vector<std::string> all;
    const auto add = [](void* list, const char* key, std::size_t length) {
      static_cast<std::vector<std::string>*>(list)->emplace_back(key, length);
    };
    board_->each(board_.get(), add, &all);
    return all;
  }

  // The run has ended.
  bool is_over() const { return board_->is_over(board_.get()); }

  void lock() const { board_->lock(board_.get()); }
  bool try_lock() const { return board_->try_lock(board_.get()); }
  void unlock() const { board_->unlock(board_.get()); }

 private:
  std::shared_ptr<BoardFamily> family_;
  BoardHandle board_;
};

inline std::shared_ptr<BoardFamily> BoardFamily::of(BoardHandle root) {
  struct Known {
    std::mutex mutex;
    std::map<lockstep_board*, std::weak_ptr<BoardFamily>> families;
  };
  static Known known;
  const std::lock_guard lock(known.mutex);
  for (auto it = known.families.begin(); it != known.families.end();) {
    it = it->second.expired() ? known.families.erase(it) : std::next(it);
  }
  auto& kept = known.families[root.get()];
  auto family = kept.lock();
  if (family == nullptr) kept = family = std::make_shared<BoardFamily>(std::move(root));
  return family;
}

}  // namespace BT::lockstep_detail
