#include "show/view/lines_below.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/terminal/text_line.h"

namespace lockstep::host {
namespace {

// Those that have a value; the first `count` of them are those that changed last, in this order.
std::vector<std::size_t> latest(const Snapshot& snapshot, std::size_t count) {
  std::vector<std::size_t> known;
  for (std::size_t entry = 0; entry < snapshot.entries.size(); ++entry) {
    if (snapshot.entries[entry].changed) known.push_back(entry);
  }
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(std::min(count, known.size()));
  std::partial_sort(known.begin(), middle, known.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(snapshot.entries[b].changed, a) < std::pair(snapshot.entries[a].changed, b);
  });
  return known;
}

std::string entry_line(std::string_view key, const EntryState& entry, const DrawOptions& options) {
  TextLine line(options.width, options.color, options.unicode);
  line.add(key);
  line.add(" = ");
  line.add(entry.is_long ? "(too long to be shown)" : entry.text);
  if (!entry.is_older) line.add(fmt::format("  tick {}", *entry.changed), Style::Dim);
  return line.text() + "\n";
}

}  // namespace

std::string entry_lines(const Shape& tree, const Snapshot& snapshot, const DrawOptions& options,
                        std::size_t room) {
  const std::vector<std::size_t> known = latest(snapshot, options.entries);
  std::size_t shown = std::min({options.entries, known.size(), room});
  if (shown == room && shown > 0 && shown < known.size()) --shown;  // for the line that counts
  if (shown == 0) return {};
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    text += entry_line(tree.entries[known[i]].key, snapshot.entries[known[i]], options);
  }
  if (shown == known.size()) return text;
  TextLine rest(options.width, options.color, options.unicode);
  const std::size_t others = known.size() - shown;
  rest.add(fmt::format("... {} more {}", others, others == 1 ? "entry" : "entries"), Style::Dim);
  return text + rest.text() + "\n";
}

std::string log_lines(const Snapshot& snapshot, const DrawOptions& options, std::size_t room) {
  const auto& all = snapshot.logs.lines;
  const std::size_t shown = std::min({options.logs, all.size(), room});
  std::string text;
  for (std::size_t i = all.size() - shown; i < all.size(); ++i) text += log_line(all[i], options);
  return text;
}

std::string log_line(const LeafLine& log, const DrawOptions& options) {
  TextLine line(options.width, options.color, options.unicode);
  line.add(log.who + ": " + log.level + ": " + log.text, Style::Dim);
  return line.text() + "\n";
}

}  // namespace lockstep::host
