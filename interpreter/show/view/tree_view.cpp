#include "show/view/tree_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/core/diagnostics.h"
#include "base/core/resource_set.h"
#include "base/core/synchronization.h"
#include "base/core/utf8.h"
#include "base/core/wording.h"
#include "base/terminal/text_line.h"
#include "judge/summary/summary.h"
#include "show/view/lines_below.h"
#include "show/view/progress_bar.h"
#include "show/view/waiting.h"
#include "trace/progress_text.h"

namespace lockstep::host {
namespace {

struct Look {
  std::string_view unicode, ascii;
  Style style;
};

Look look_of(Activity activity) {
  if (activity == Activity::Paused) return {"‖", "=", Style::Warning};
  const StatusRow& row = row_of(status_of(activity));
  return {row.sign, row.ascii_sign, row.style};
}

const Browsing& browsing_of(const DrawOptions& options) {
  static const Browsing kNone;
  return options.browsing == nullptr ? kNone : *options.browsing;
}

class View {
 public:
  View(const Shape& tree, const Snapshot& snapshot, const DrawOptions& options)
      : tree_(tree), snapshot_(snapshot), options_(options), browsing_(browsing_of(options)) {}

  std::string draw() {
    const Layout layout = lay_out(tree_, snapshot_, browsing_, rows_for_nodes(options_));
    outermost_ = SIZE_MAX;
    for (const NodeIndex node : layout.rows) {
      outermost_ = std::min(outermost_, tree_.nodes[node].depth);
    }
    std::string text = header();
    for (const NodeIndex node : layout.rows) text += row(node);
    if (browsing_.cursor && layout.rows.size() < layout.all) return text + place(layout);
    if (layout.left_out.sum() > 0) return text + left_out(layout.left_out);
    return text + below(rows_for_nodes(options_) - layout.rows.size());
  }

 private:
  TextLine new_line() const { return {options_.width, options_.color, options_.unicode}; }
  bool is_synchronized(NodeIndex node) const {
    return tree_.nodes[node].synchronization != Synchronization::None;
  }
  bool has_bar(NodeIndex node) const { return tree_.nodes[node].keeper.has_value(); }
  // A deep node must not be out of sight.
  std::size_t indent(NodeIndex node) const {
    return std::min<std::size_t>(2 * (tree_.nodes[node].depth - outermost_), options_.width / 2);
  }

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
    if (is.resumed_after) {
      line.add(fmt::format("  resumed after {}", duration_text(*is.resumed_after)));
    }
    if (is.result) {
      line.add("  ");
      line.add(to_string(*is.result), style_of(*is.result));
    }
    return line.text() + "\n";
  }

  std::string left_out(const Tally& tally) const {
    TextLine line = new_line();
    line.add(fmt::format("... {} left out: {}", counted(tally.sum(), "node"), tally.text()),
             Style::Dim);
    if (options_.keys) line.add(fmt::format("  {} scroll", up_down()), Style::Dim);
    return line.text() + "\n";
  }

  std::string place(const Layout& layout) const {
    TextLine line = new_line();
    line.add(fmt::format("rows {} to {} of {}", layout.first + 1, layout.first + layout.rows.size(),
                         layout.all),
             Style::Dim);
    if (options_.keys) {
      line.add(fmt::format("  {} scroll  f fold  F unfold all  esc follow", up_down()), Style::Dim);
    }
    return line.text() + "\n";
  }

  std::string below(std::size_t room) const {
    const std::string entries = entry_lines(tree_, snapshot_, options_, room);
    room -= static_cast<std::size_t>(std::ranges::count(entries, '\n'));
    return entries + log_lines(snapshot_, options_, room);
  }

  std::string_view up_down() const { return options_.unicode ? "↑ ↓" : "up down"; }

  // Only while there is a cursor.
  void add_cursor(TextLine& line, NodeIndex node) const {
    if (!browsing_.cursor) return;
    const bool here = *browsing_.cursor == node;
    line.add(!here ? "  " : options_.unicode ? "→ " : "* ", Style::Strong);
  }

  void add_round(TextLine& line, const Round& round) const {
    if (round.number == 0) return;
    line.add(round.of == 0 ? fmt::format("  {}", round.number)
                           : fmt::format("  {}/{}", round.number, round.of));
  }

  // Sums up the nodes below a node that is folded.
  void add_folded(TextLine& line, NodeIndex node) const {
    if (browsing_.folded.count(node) == 0) return;
    const Tally below = tally_below(tree_, snapshot_, node);
    line.add(fmt::format("  + {}: {}", counted(below.sum(), "node"), below.text()), Style::Dim);
  }

  std::string row(NodeIndex node) const {
    const Look look = look_of(snapshot_.nodes[node].activity);
    const ShapeNode& shape = tree_.nodes[node];
    TextLine line = new_line();
    add_cursor(line, node);
    line.fill_to(line.column() + indent(node));
    line.add(options_.unicode ? look.unicode : look.ascii, look.style);
    line.add(" ");
    line.add(shape.segment, is_synchronized(node) ? Style::Strong : Style::Plain);
    if (has_bar(node)) add_bar(line, node, look.style);
    if (!has_bar(node) && shape.segment != shape.kind) {
      line.add(fmt::format(" ({})", shape.kind), Style::Dim);
    }
    add_round(line, snapshot_.nodes[node].round);
    add_folded(line, node);
    return line.text() + "\n";
  }

  // Shared by the bars of all children of one node.
  struct Children {
    std::vector<double> progress;
    std::vector<double> counted;  // not a number for those that nobody waits for
    double least = 1;
    std::size_t columns = 0;  // of the longest name
  };

  // Looked at once, however many there are.
  const Children& children_of(NodeIndex parent) const {
    const auto [entry, is_new] = children_.try_emplace(parent);
    Children& children = entry->second;
    if (!is_new) return children;
    for (const NodeIndex child : tree_.nodes[parent].held()) {
      const NodeView& view = snapshot_.nodes[child];
      children.progress.push_back(view.progress);
      const bool is_left_out =
          view.activity == Activity::Skipped ||
          (tree_.nodes[parent].ignores_idle && view.activity == Activity::Idle);
      children.counted.push_back(is_left_out ? std::numeric_limits<double>::quiet_NaN()
                                             : view.progress);
      if (!is_left_out) children.least = std::min(children.least, view.progress);
      children.columns = std::max(children.columns, columns(printable(tree_.nodes[child].segment)));
    }
    return children;
  }

  void add_bar(TextLine& line, NodeIndex node, Style style) const {
    const NodeIndex self = *tree_.nodes[node].keeper;
    const auto& in_step = tree_.nodes[self].held();
    const auto& [progress, counted, least, name] = children_of(self);
    const auto found = std::lower_bound(in_step.begin(), in_step.end(), node);
    const auto place = static_cast<std::size_t>(found - in_step.begin());
    const std::size_t gutter = browsing_.cursor ? 2 : 0;
    line.fill_to(gutter + indent(node) + 3 + std::min<std::size_t>(name, 24));
    line.add(bar(self, progress[place], least), style);
    line.add(fmt::format(" {:.2f}", progress[place]));
    if (const NodeView& view = snapshot_.nodes[node]; view.factor < 1) {
      line.add(fmt::format(" {}{:.2f}", options_.unicode ? "×" : "x", view.factor), Style::Dim);
    }
    if (tree_.nodes[self].synchronization == Synchronization::Resources) {
      return add_ownership(line, self, place);
    }
    // Under a parent that is held itself, the parent says what is waited for.
    const Activity parent = snapshot_.nodes[*tree_.nodes[node].parent].activity;
    if (parent == Activity::Paused) return;
    const bool begins =
        is_beside(self) && waits_to_begin(status(*tree_.nodes[node].parent), status(node));
    if (!begins && snapshot_.nodes[node].activity != Activity::Paused) return;
    line.add("  ");
    line.add(waiting(self, counted, place, begins), Style::Warning);
  }

  Status status(NodeIndex node) const { return status_of(snapshot_.nodes[node].activity); }
  bool is_beside(NodeIndex node) const { return !tree_.nodes[node].parent && node != 0; }

  void add_ownership(TextLine& line, NodeIndex pool, std::size_t place) const {
    const ShapeNode& shape = tree_.nodes[pool];
    const auto limit = [&](std::size_t child) {
      return snapshot_.nodes[shape.held()[child] - 1].limit;
    };
    const std::string text = ownership_text(
        {.resources = shape.resources,
         .members = shape.held().size(),
         .limit = limit,
         .name_of = [&](std::size_t child) { return printable(shape.names[child]); }},
        place);
    if (text.empty()) return;
    line.add("  ");
    line.add(text, waits(limit(place)) ? Style::Warning : Style::Plain);
  }

  std::string waiting(NodeIndex node, const std::vector<double>& progress, std::size_t place,
                      bool begins) const {
    const ShapeNode& shape = tree_.nodes[node];
    const WaitedAt waited{
        .synchronization = shape.synchronization,
        .limit = snapshot_.nodes[node].limit,
        .progress = progress,
        .name_of =
            [&](std::size_t child) {
              return shape.names.empty() ? tree_.nodes[shape.held()[child]].segment
                                         : shape.names[child];
            },
        .group = is_beside(node) ? shape.segment : "",
        .lost = [&](std::size_t child) { return lost(shape.held()[child]); },
        .heard = [&](std::size_t child) { return last_word(shape.held()[child]); }};
    if (!begins) return waiting_text(waited, place);
    return beginning_text(waited, [&](std::size_t child) {
      return status(*tree_.nodes[shape.held()[child]].parent) == Status::Running;
    });
  }

  std::string last_word(NodeIndex robot) const {
    const auto it = std::ranges::find(snapshot_.heard, robot, &Heard::node);
    if (it == snapshot_.heard.end() || it->word == 0) return "";
    return heard_text(snapshot_.nodes[robot].progress, snapshot_.header.time - it->time);
  }

  std::string lost(NodeIndex node) const {
    if (!is_robot(tree_, node) || status(node) != Status::Failure) return "";
    const std::string last = last_word(node);
    return last.empty() ? "it is not heard" : "it cannot be relied on (" + last + ")";
  }

  // Barriers that an entry gives are not known but for the current one.
  std::string bar(NodeIndex node, double progress, double least) const {
    const ShapeNode& shape = tree_.nodes[node];
    const double most =
        std::min(1.0, farthest(shape.synchronization, snapshot_.nodes[node].limit, least));
    const auto barriers =
        shape.barriers ? std::span<const double>(*shape.barriers) : std::span<const double>();
    const bool relative = shape.synchronization == Synchronization::Relative;
    ProgressBar bar{.progress = progress,
                    .marks = barriers,
                    .cells = std::clamp<std::size_t>(options_.width / 4, 8, 40)};
    // An idle node has no limit yet.
    if (barriers.empty() && most > 0 && compares_progress(shape.synchronization))
      bar.marks = {&most, 1};
    if (relative) bar.band_begin = least;
    if (relative) bar.band_end = most;
    return to_text(bar, options_.unicode);
  }

  const Shape& tree_;
  const Snapshot& snapshot_;
  const DrawOptions& options_;
  const Browsing& browsing_;
  std::size_t outermost_ = 0;                       // the least depth of the rows
  mutable std::map<NodeIndex, Children> children_;  // of the parents seen so far
};

}  // namespace

std::size_t rows_for_nodes(const DrawOptions& options) {
  return options.height > 3 ? options.height - 2 : 1;
}

std::string draw(const Shape& tree, const Snapshot& snapshot, const DrawOptions& options) {
  return View(tree, snapshot, options).draw();
}

}  // namespace lockstep::host
