// Which entries a recording and a view show as changed.
#include "judge/measure/entry_changes.h"

#include <catch2/catch.hpp>
#include <string>

#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

// Two entries that are read by nodes: 0 is 'pause', 1 is 'plan'.
struct WatchedBoard {
  Tree tree =
      tree_from_text("Parallel(Wait[seconds={pause}] ParallelAbsolute[barriers={plan}](a))");
  Blackboard board{tree};

  void set(std::size_t slot, Value value) { board.entries[slot].assign(std::move(value)); }
};

// "0=0.5 1=(too long)"
std::string text_of(std::span<const EntryChange> changes) {
  std::string text;
  for (const EntryChange& it : changes) {
    text += (text.empty() ? "" : " ") + std::to_string(it.entry) + "=" +
            (it.text == nullptr ? "(too long)" : *it.text);
  }
  return text;
}

}  // namespace

TEST_CASE("entries: one is shown when it has another value than in the last line") {
  WatchedBoard it;
  EntryChanges changes({0, 1});
  CHECK(text_of(changes.changes(it.board.entries)).empty());  // nobody has written anything
  it.set(0, 0.5);
  it.set(1, std::vector<double>{0.25, 1});
  CHECK(text_of(changes.changes(it.board.entries)) == "0=0.5 1=0.25;1");
  CHECK(text_of(changes.changes(it.board.entries)) ==
        "0=0.5 1=0.25;1");  // the file did not take it
  changes.keep();
  CHECK(text_of(changes.changes(it.board.entries)).empty());
  it.set(0, 0.5);  // the same value
  CHECK(text_of(changes.changes(it.board.entries)).empty());
  it.set(0, 0.75);
  CHECK(text_of(changes.changes(it.board.entries)) == "0=0.75");
}

TEST_CASE("entries: one that was written between ticks is marked until a line has it") {
  WatchedBoard it;
  EntryChanges changes({0, 1});
  it.set(0, 0.5);
  it.set(1, std::vector<double>{1});
  REQUIRE(changes.changes(it.board.entries).size() == 2);
  changes.keep();
  const auto is_set = [&] {
    std::vector<bool> all;
    for (const EntryChange& change : changes.changes(it.board.entries)) {
      all.push_back(change.is_set);
    }
    return all;
  };
  it.set(0, 0.75);
  changes.before_tick(it.board.entries);
  it.set(1, std::vector<double>{0.5, 1});  // by the tick
  CHECK(is_set() == std::vector{true, false});
  changes.before_tick(it.board.entries);
  CHECK(is_set() == std::vector{true, false});  // the file did not take it
  changes.keep();
  changes.before_tick(it.board.entries);
  it.set(0, 0.5);
  CHECK(is_set() == std::vector{false});
}

TEST_CASE("entries: what a tick writes again has the value that came from outside") {
  WatchedBoard it;
  EntryChanges changes({0});
  it.set(0, 0.5);
  changes.begin(it.board.entries);
  const auto given = [&](std::optional<double> from_outside, std::optional<double> by_tick) {
    if (from_outside) it.set(0, *from_outside);
    changes.before_tick(it.board.entries);
    if (by_tick) it.set(0, *by_tick);
    std::string text;
    for (const EntryChange& change : changes.changes(it.board.entries)) {
      text += *change.text + (change.is_set ? " set" : "");
      if (change.is_written_again) text += " given " + *change.given;
    }
    changes.keep();
    return text;
  };
  CHECK(given(std::nullopt, std::nullopt) == "0.5");  // the first line has all
  CHECK(given(0.75, std::nullopt) == "0.75 set");
  CHECK(given(1.0, 0.25) == "0.25 set given 1");
  CHECK(given(1.0, 0.25) == "0.25 set given 1");  // a button that the tree puts back
  CHECK(given(0.25, std::nullopt).empty());
  CHECK(given(std::nullopt, 0.25).empty());
}

TEST_CASE("entries: of values that are too long, it is not known whether they were written again") {
  Tree tree = tree_from_text("ParallelAbsolute[barriers={plan}](a)");
  Blackboard board{tree};
  EntryChanges changes({0});
  changes.begin(board.entries);
  const std::vector<double> all(300, 0.5);
  board.entries[0].assign(Value(all));
  changes.before_tick(board.entries);
  const auto found = changes.changes(board.entries);
  REQUIRE(found.size() == 1);
  CHECK(found[0].is_set);
  CHECK(found[0].text == nullptr);
  CHECK(!found[0].is_written_again);
  board.entries[0].assign(Value(std::vector<double>{0.5}));
  const auto short_again = changes.changes(board.entries);
  REQUIRE(short_again.size() == 1);
  CHECK(short_again[0].is_written_again);
  CHECK(short_again[0].given == nullptr);
}

TEST_CASE("entries: only those that were asked for, numbered in their order") {
  WatchedBoard it;
  EntryChanges changes({1});
  it.set(0, 0.5);
  it.set(1, std::vector<double>{0.5});
  CHECK(text_of(changes.changes(it.board.entries)) == "0=0.5");
  CHECK(changes.changes(it.board.entries).size() == 1);
}

TEST_CASE("entries: a value of more than 256 bytes is only named, each time it is written") {
  WatchedBoard it;
  EntryChanges changes({0, 1});
  it.set(0, std::string(EntryChanges::kLongest, 'x'));
  CHECK(changes.changes(it.board.entries)[0].text->size() == EntryChanges::kLongest);
  changes.keep();
  it.set(0, std::string(EntryChanges::kLongest + 1, 'x'));
  CHECK(text_of(changes.changes(it.board.entries)) == "0=(too long)");
  changes.keep();
  CHECK(changes.changes(it.board.entries).empty());
  it.set(0, std::string(EntryChanges::kLongest + 1, 'y'));
  CHECK(changes.changes(it.board.entries).size() == 1);
  changes.keep();
  it.set(1, std::vector<double>(200, 0.123456));
  CHECK(text_of(changes.changes(it.board.entries)) == "1=(too long)");
}

}  // namespace lockstep::host::test
