// Coverage as a table, and as lcov has it.
#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "scenario/coverage.h"

namespace lockstep::host {
namespace {

// '+': a scenario shows it; '-': none does, and it can be; ' ': it cannot be.
char aspect_sign(const CoveredNode& node, std::size_t aspect) {
  const auto it = static_cast<Aspect>(aspect);
  if (node.seen.has(it)) return '+';
  return node.possible.has(it) ? '-' : ' ';
}

std::string barriers_text(const CoveredNode& node) {
  std::string text;
  for (const auto& [barrier, is_reached] : node.barriers) {
    text += fmt::format("  {}{}", is_reached ? '+' : '-', barrier);
  }
  return text.empty() ? text : "  barriers" + text;
}

std::string rest_text(const CoveredTree& tree) {
  return fmt::format("{:.1f} % ({} of {}){}", percent(std::span(&tree, 1)), tree.shown(),
                     tree.all(),
                     tree.is_proved ? ", of what verify proves possible"
                                    : ", of what is usual: verify cannot determine it");
}

}  // namespace

std::string to_table(std::span<const CoveredTree> trees) {
  std::string text;
  for (const CoveredTree& tree : trees) {
    text += fmt::format("coverage of {}: {}\n", printable(tree.file), rest_text(tree));
    std::size_t width = 4;
    for (const CoveredNode& it : tree.nodes) width = std::max(width, it.path.size());
    text += fmt::format("  {:<{}}", "", width);
    for (const std::string_view it : kAspects) text += fmt::format("  {}", it);
    text += '\n';
    for (const CoveredNode& node : tree.nodes) {
      std::string line = fmt::format("  {:<{}}", printable(node.path), width);
      for (std::size_t aspect = 0; aspect < kAspectCount; ++aspect) {
        line += fmt::format("  {:<{}}", aspect_sign(node, aspect), kAspects[aspect].size());
      }
      line += barriers_text(node);
      while (line.ends_with(' ')) line.pop_back();
      text += line + '\n';
    }
  }
  return text;
}

std::string to_lcov(std::span<const CoveredTree> trees) {
  std::map<std::string, std::vector<const CoveredNode*>> files;
  for (const CoveredTree& tree : trees) {
    for (const CoveredNode& it : tree.nodes) files[it.place.file].push_back(&it);
  }
  std::string text;
  for (auto& [file, nodes] : files) {
    text += fmt::format("TN:\nSF:{}\n", file);
    std::map<std::uint32_t, std::uint64_t> lines;
    std::size_t branches = 0, taken = 0;
    for (std::size_t block = 0; block < nodes.size(); ++block) {
      const CoveredNode& it = *nodes[block];
      lines[it.place.line] += it.ticks;
      for (std::size_t aspect = 0; aspect < kAspectCount; ++aspect) {
        if (!it.possible.has(static_cast<Aspect>(aspect))) continue;
        const bool is_seen = it.seen.has(static_cast<Aspect>(aspect));
        text += fmt::format("BRDA:{},{},{},{}\n", it.place.line, block, aspect, is_seen ? 1 : 0);
        ++branches;
        taken += is_seen ? 1 : 0;
      }
    }
    text += fmt::format("BRF:{}\nBRH:{}\n", branches, taken);
    std::size_t hit = 0;
    for (const auto& [line, ticks] : lines) {
      text += fmt::format("DA:{},{}\n", line, ticks);
      hit += ticks > 0 ? 1 : 0;
    }
    text += fmt::format("LF:{}\nLH:{}\nend_of_record\n", lines.size(), hit);
  }
  return text;
}

}  // namespace lockstep::host
