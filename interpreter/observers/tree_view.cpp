#include "observers/tree_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "observers/progress_bar.h"
#include "observers/summary.h"
#include "observers/text_line.h"
#include "observers/waiting.h"

namespace lockstep {
namespace {

struct Look {
  std::string_view ascii, unicode;
  Style style;
};

Look look_of(Activity activity) {
  switch (activity) {
    case Activity::Idle:
      return {"-", "·", Style::Dim};
    case Activity::Running:
      return {">", "▶", Style::Active};
    case Activity::Success:
      return {"+", "✓", Style::Good};
    case Activity::Failure:
      return {"x", "✗", Style::Bad};
    case Activity::Paused:
      return {"=", "‖", Style::Warning};
  }
  return {};
}

class View {
 public:
  View(const TreeShape& tree, const Snapshot& snapshot, const DrawOptions& options)
      : tree_(tree), snapshot_(snapshot), options_(options) {}

  std::string draw() const {
    std::string text = header();
    const std::size_t rows = options_.height > 3 ? options_.height - 2 : 1;
    const auto shown = choose(rows);
    for (const NodeIndex node : shown) text += row(node);
    const std::size_t left_out = tree_.nodes.size() - shown.size();
    if (left_out == 0) return text;
    TextLine line = new_line();
    line.add(fmt::format("... {} nodes left out", left_out), Style::Dim);
    return text + line.text() + "\n";
  }

 private:
  TextLine new_line() const { return {options_.width, options_.color, options_.unicode}; }
  bool is_synchronized(NodeIndex node) const {
    return tree_.nodes[node].synchronization != Synchronization::None;
  }
  bool has_bar(NodeIndex node) const {
    const auto parent = tree_.nodes[node].parent;
    return parent && is_synchronized(*parent);
  }
  std::size_t indent(NodeIndex node) const { return 2 * tree_.nodes[node].depth; }

  std::string header() const {
    const Snapshot::Header& is = snapshot_.header;
    TextLine line = new_line();
    line.add(tree_.id, Style::Strong);
    line.add(fmt::format("  {:.6g} Hz{}  tick {}  {:.3f} s", is.rate_hz,
                         is.real_time ? "" : " (virtual)", is.tick, to_seconds(is.time)));
    if (is.real_time && is.overruns) {
      const Style style = *is.overruns == 0 ? Style::Plain : Style::Warning;
      line.add(fmt::format("  overruns {}", *is.overruns), style);
    }
    if (is.result) {
      line.add("  ");
      line.add(to_string(*is.result), style_of(*is.result));
    }
    return line.text() + "\n";
  }

  // What must be seen first, when not all can be.
  int rank(NodeIndex node) const {
    if (node == 0 || is_synchronized(node) || has_bar(node)) return 0;
    const bool running = status_of(snapshot_.nodes[node].activity) == Status::Running;
    if (!running) return 3;
    return tree_.nodes[node].children.empty() ? 1 : 2;
  }

  // In the order of the tree; one row is kept for the note when nodes are left out.
  std::vector<NodeIndex> choose(std::size_t rows) const {
    std::vector<NodeIndex> nodes(tree_.nodes.size());
    std::iota(nodes.begin(), nodes.end(), NodeIndex{0});
    if (nodes.size() <= rows) return nodes;
    std::stable_sort(nodes.begin(), nodes.end(),
                     [this](NodeIndex a, NodeIndex b) { return rank(a) < rank(b); });
    nodes.resize(rows - 1);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  std::string row(NodeIndex node) const {
    const Look look = look_of(snapshot_.nodes[node].activity);
    const ShapeNode& shape = tree_.nodes[node];
    TextLine line = new_line();
    line.fill_to(indent(node));
    line.add(options_.unicode ? look.unicode : look.ascii, look.style);
    line.add(" ");
    line.add(shape.segment, is_synchronized(node) ? Style::Strong : Style::Plain);
    if (has_bar(node)) add_bar(line, node, look.style);
    if (!has_bar(node) && shape.segment != shape.kind) {
      line.add(fmt::format(" ({})", shape.kind), Style::Dim);
    }
    return line.text() + "\n";
  }

  // What the bars of all children of one node have in common.
  struct Children {
    std::vector<double> progress;
    double least = 1;
    std::size_t columns = 0;  // of the longest name
  };

  // Looked at once, however many there are.
  const Children& children_of(NodeIndex parent) const {
    const auto [entry, is_new] = children_.try_emplace(parent);
    Children& children = entry->second;
    if (!is_new) return children;
    for (const NodeIndex child : tree_.nodes[parent].children) {
      children.progress.push_back(snapshot_.nodes[child].progress);
      children.least = std::min(children.least, children.progress.back());
      children.columns = std::max(children.columns, columns(tree_.nodes[child].segment));
    }
    return children;
  }

  void add_bar(TextLine& line, NodeIndex node, Style style) const {
    const NodeIndex self = *tree_.nodes[node].parent;
    const ShapeNode& parent = tree_.nodes[self];
    const auto& [progress, least, name] = children_of(self);
    const auto found = std::lower_bound(parent.children.begin(), parent.children.end(), node);
    const auto place = static_cast<std::size_t>(found - parent.children.begin());
    line.fill_to(indent(node) + 3 + std::min<std::size_t>(name, 24));
    line.add(bar(parent, progress[place], least), style);
    line.add(fmt::format(" {:.2f}", progress[place]));
    // Under a parent that is held itself, the parent says what is waited for.
    if (snapshot_.nodes[node].activity != Activity::Paused ||
        snapshot_.nodes[self].activity == Activity::Paused) {
      return;
    }
    line.add("  ");
    line.add(waiting(parent, progress, place), Style::Warning);
  }

  std::string waiting(const ShapeNode& parent, const std::vector<double>& progress,
                      std::size_t place) const {
    return waiting_text(
        {.synchronization = parent.synchronization,
         .barriers = parent.barriers,
         .delta = parent.delta,
         .name_of = [&](std::size_t child) { return tree_.nodes[parent.children[child]].segment; }},
        progress, place);
  }

  std::string bar(const ShapeNode& parent, double progress, double least) const {
    ProgressBar bar{.progress = progress,
                    .marks = parent.barriers,
                    .cells = std::clamp<std::size_t>(options_.width / 4, 8, 40)};
    double limit = 1;
    if (parent.synchronization == Synchronization::Relative) {
      bar.band_begin = least;
      bar.band_end = std::min(1.0, bar.band_begin + parent.delta);
      limit = bar.band_end;
      bar.marks = {&limit, 1};
    }
    return to_text(bar, options_.unicode);
  }

  const TreeShape& tree_;
  const Snapshot& snapshot_;
  const DrawOptions& options_;
  mutable std::map<NodeIndex, Children> children_;  // of the parents seen so far
};

}  // namespace

std::string draw(const TreeShape& tree, const Snapshot& snapshot, const DrawOptions& options) {
  return View(tree, snapshot, options).draw();
}

}  // namespace lockstep
