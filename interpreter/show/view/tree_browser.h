// Applies keys to a view of a tree: scroll, fold, follow the running nodes again. Used by the live
// view and by replays; knows no terminal.
#pragma once

#include "base/terminal/keys.h"
#include "show/view/tree_layout.h"

namespace lockstep::host {

class TreeBrowser {
 public:
  // `tree` must outlive it.
  explicit TreeBrowser(const Shape& tree) : tree_(tree) {}

  // Returns false if the key has no meaning here. `now` is the current view, with this many rows.
  bool press(Key key, const Snapshot& now, std::size_t rows);
  const Browsing& browsing() const { return browsing_; }

 private:
  bool press_character(char character, const Snapshot& now);
  bool move(std::ptrdiff_t rows, const Snapshot& now);
  bool fold(const Snapshot& now);

  const Shape& tree_;
  Browsing browsing_;
};

}  // namespace lockstep::host
