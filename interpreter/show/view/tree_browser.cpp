#include "show/view/tree_browser.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// Where browsing begins: at the first leaf that runs, else at the root.
NodeIndex first_active(const Shape& tree, const Snapshot& now) {
  for (NodeIndex node = 0; node < now.nodes.size(); ++node) {
    if (now.nodes[node].activity == Activity::Running && tree.nodes[node].children.empty()) {
      return node;
    }
  }
  return 0;
}

}  // namespace

bool TreeBrowser::press(Key key, const Snapshot& now, std::size_t rows) {
  const auto page = static_cast<std::ptrdiff_t>(std::max<std::size_t>(rows, 2) - 1);
  switch (key.kind) {
    case KeyKind::Up:
      return move(-1, now);
    case KeyKind::Down:
      return move(1, now);
    case KeyKind::PageUp:
      return move(-page, now);
    case KeyKind::PageDown:
      return move(page, now);
    case KeyKind::Escape:
      browsing_.cursor.reset();
      return true;
    case KeyKind::Character:
      return press_character(key.character, now);
    default:
      return false;
  }
}

bool TreeBrowser::press_character(char character, const Snapshot& now) {
  if (character == 'f') return fold(now);
  if (character != 'F') return false;
  browsing_.folded.clear();
  return true;
}

// The first key only shows the cursor.
bool TreeBrowser::move(std::ptrdiff_t rows, const Snapshot& now) {
  const std::vector<NodeIndex> shown = unfolded(tree_, browsing_.folded);
  const NodeIndex from = browsing_.cursor.value_or(first_active(tree_, now));
  // A node that is folded away stands for what it is folded into.
  const auto at = std::upper_bound(shown.begin(), shown.end(), from) - 1 - shown.begin();
  const auto last = static_cast<std::ptrdiff_t>(shown.size()) - 1;
  const std::ptrdiff_t step = browsing_.cursor ? rows : 0;
  browsing_.cursor =
      shown[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + step, 0, last))];
  return true;
}

// A leaf has nothing to fold: its parent does.
bool TreeBrowser::fold(const Snapshot& now) {
  if (!browsing_.cursor) return move(0, now);
  NodeIndex node = *browsing_.cursor;
  if (tree_.nodes[node].children.empty()) node = tree_.nodes[node].parent.value_or(node);
  if (tree_.nodes[node].children.empty()) return true;
  if (browsing_.folded.erase(node) == 0) browsing_.folded.insert(node);
  browsing_.cursor = node;
  return true;
}

}  // namespace lockstep::host
