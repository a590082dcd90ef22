#include "leaves/plugin/contract/boards.h"

#include <cstring>
#include <utility>

#include "leaves/plugin/contract/entry_value.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {

BoardsOfRun::BoardsOfRun(const Tree& tree, Blackboard& blackboard)
    : tree_(&tree), blackboard_(&blackboard), lock_(blackboard.lock) {
  for (std::uint32_t index = 0; index < tree.boards.size(); ++index) {
    boards_.push_back({this, index});
    parents_.push_back(tree.boards[index].parent);
    for (const auto& [key, slot] : tree.boards[index].entries) {
      homes_.emplace(tree.slots[slot].name.data(), Home{index, key});
    }
  }
}

void BoardsOfRun::end() {
  const InEngine scope(lock_.get());
  blackboard_ = nullptr;
  tree_ = nullptr;
}

lockstep_board* BoardsOfRun::retain(std::uint32_t index) {
  if (index >= boards_.size()) return nullptr;
  ++owners_;
  return &boards_[index];
}

void BoardsOfRun::release() {
  if (--owners_ == 0) delete this;
}

void EndBoards::operator()(BoardsOfRun* boards) const {
  boards->end();
  boards->release();
}

OwnBoards make_boards(const Tree& tree, Blackboard& blackboard) {
  if (blackboard.lock == nullptr || tree.boards.empty()) return nullptr;
  return OwnBoards(new BoardsOfRun(tree, blackboard));
}

namespace {

// The entries of a board, for the time of one call.
class Open {
 public:
  explicit Open(lockstep_board& board)
      : scope_(&board.run->lock()), run_(*board.run), index_(board.index) {}

  bool is_over() const { return run_.blackboard() == nullptr; }
  BoardsOfRun& run() const { return run_; }
  const Tree& tree() const { return run_.tree(); }
  NamedEntries& names() const { return run_.blackboard()->names; }
  Entry& at(std::string_view key) const { return names().at(index_, key); }
  Entry* own(std::string_view key) const { return names().own(index_, key); }
  Entry* find(std::string_view key) const { return names().find(index_, key); }

 private:
  const InEngine scope_;
  BoardsOfRun& run_;
  const std::uint32_t index_;
};

template <class Result, class Work>
Result shielded(Result otherwise, Work work) {
  try {
    return work();
  } catch (const std::exception&) {
    return otherwise;  // out of memory
  }
}

lockstep_board* of(const lockstep_caller* caller) {
  BoardsOfRun* const boards = caller->run->boards;
  if (boards == nullptr || caller->type == nullptr) return nullptr;
  return boards->retain(caller->run->tree->board_of(caller->node));
}

std::uint32_t of_port(const lockstep_caller* caller, std::uint32_t port, const char** name,
                      std::size_t* length) {
  BoardsOfRun* const boards = caller->run->boards;
  if (boards == nullptr || port >= caller->ports.size()) return Board::kNone;
  const Home* const home = boards->home_of_slot(caller->ports[port]->entry);
  if (home == nullptr) return Board::kNone;
  *name = home->key.data();
  *length = home->key.size();
  return home->board;
}

lockstep_board* at(lockstep_board* board, std::uint32_t index) {
  return board->run->retain(index);
}

void release(lockstep_board* board) {
  board->run->release();
}

std::uint32_t index_of(const lockstep_board* board) {
  return board->index;
}

bool is_over(lockstep_board* board) {
  return Open(*board).is_over();
}

std::uint32_t parent(const lockstep_board* board) {
  return board->run->parent(board->index);
}

void lock(lockstep_board* board) {
  board->run->lock().enter();
}

void unlock(lockstep_board* board) {
  board->run->lock().leave();
}

bool try_lock(lockstep_board* board) {
  return board->run->lock().try_to_enter();
}

std::uint32_t home(lockstep_board* board, const char* key, std::size_t length, const char** name,
                   std::size_t* name_length) {
  const Open open(*board);
  *name = key;
  *name_length = length;
  if (open.is_over()) return board->index;
  const Home found = home_of(open.tree().boards, board->index, {key, length});
  *name = found.key.data();
  *name_length = found.key.size();
  return found.board;
}

bool read(lockstep_board* board, const char* key, std::size_t length, lockstep_entry_value* value) {
  return shielded(false, [&] {
    const Open open(*board);
    Entry* const entry = open.is_over() ? nullptr : open.find({key, length});
    if (entry == nullptr || !entry->is_present) return false;
    lockstep_entry_value found = described(*entry, open.run().texts());
    found.writes = open.run().writes(*entry);
    const std::size_t size = std::min<std::size_t>(value->struct_size, sizeof found);
    found.struct_size = value->struct_size;
    std::memcpy(value, &found, size);
    return true;
  });
}

bool write(lockstep_board* board, const char* key, std::size_t length,
           const lockstep_entry_value* given) {
  return shielded(false, [&] {
    const Open open(*board);
    if (open.is_over()) return false;
    lockstep_entry_value value{};
    std::memcpy(&value, given, std::min<std::size_t>(given->struct_size, sizeof value));
    return assign(open.at({key, length}), value);
  });
}

void unset(lockstep_board* board, const char* key, std::size_t length) {
  shielded(false, [&] {
    const Open open(*board);
    Entry* const entry = open.is_over() ? nullptr : open.own({key, length});
    if (entry != nullptr && entry->typing != Typing::Strict) unset_entry(*entry);
    return true;
  });
}

void each(lockstep_board* board, void (*visit)(void* user, const char* key, std::size_t length),
          void* user) {
  const Open open(*board);
  if (open.is_over()) return;
  open.names().each(board->index, [&](std::string_view key, const Entry& entry) {
    if (entry.is_present) visit(user, key.data(), key.size());
  });
}

}  // namespace

const lockstep_boards& boards_table() {
  static constexpr lockstep_boards kTable{.struct_size = sizeof(lockstep_boards),
                                          .of = of,
                                          .of_port = of_port,
                                          .at = at,
                                          .release = release,
                                          .index = index_of,
                                          .is_over = is_over,
                                          .parent = parent,
                                          .lock = lock,
                                          .unlock = unlock,
                                          .try_lock = try_lock,
                                          .home = home,
                                          .read = read,
                                          .write = write,
                                          .unset = unset,
                                          .each = each};
  return kTable;
}

}  // namespace lockstep::host
