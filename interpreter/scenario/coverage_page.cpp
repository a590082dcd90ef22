// Coverage as a page: no scripts, so that it can be an artifact of continuous integration.
#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "describe/xsd.h"
#include "scenario/coverage.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Coverage of trees</title>
<style>
:root { color-scheme: light dark; font: 15px/1.4 system-ui, sans-serif; }
body { margin: 2em; }
table { border-collapse: collapse; }
th, td { padding: 2px 10px; text-align: left; border-bottom: 1px solid #8884; }
th.a, td.a { text-align: center; }
.all { background: #2a92; } .some { background: #ca02; } .none { background: #c332; }
td.seen { background: #2a94; } td.never { background: #c334; font-weight: 600; }
code { color: #888; }
</style></head><body>
<h1>Coverage of trees</h1>
<p>+ a scenario shows it (hold the pointer over it for which) · never: it is possible, and none does · empty: it cannot be</p>
)html";

std::string aspect_cell(const CoveredNode& node, std::size_t aspect) {
  const auto it = static_cast<Aspect>(aspect);
  if (node.seen.has(it)) {
    return fmt::format("<td class=\"a seen\" title=\"{}\">+</td>",
                       xsd_escaped(joined(node.by[aspect], "; ")));
  }
  return node.possible.has(it) ? "<td class=\"a never\">never</td>" : "<td></td>";
}

std::string barrier_cell(const CoveredNode& node) {
  std::string text = "<td>";
  for (const auto& [barrier, is_reached] : node.barriers) {
    text += fmt::format("<span class=\"{}\">{}{}</span> ", is_reached ? "all" : "none", barrier,
                        is_reached ? "" : " never");
  }
  return text + "</td>";
}

std::string page_row(const CoveredNode& node) {
  const std::size_t all = node.all(), shown = node.shown();
  const std::string_view how = shown == all ? "all" : shown == 0 ? "none" : "some";
  const auto depth = static_cast<double>(std::ranges::count(node.path, '/'));
  const std::string name = node.path.substr(node.path.rfind('/') + 1);
  std::string text = fmt::format(
      "<tr><td class=\"{}\" style=\"padding-left:{}em\">{} <code>{}</code></td>", how,
      depth * 1.5 + 0.5, xsd_escaped(name), xsd_escaped(node.kind == name ? "" : node.kind));
  for (std::size_t aspect = 0; aspect < kAspectCount; ++aspect) text += aspect_cell(node, aspect);
  return text + barrier_cell(node) +
         fmt::format("<td><code>{}</code></td></tr>\n", xsd_escaped(to_text(node.place)));
}

}  // namespace

std::string to_page(std::span<const CoveredTree> trees) {
  std::string text(kHead);
  for (const CoveredTree& tree : trees) {
    text +=
        fmt::format("<h2>{}: {:.1f} %</h2>\n<p>{} of {}{}.</p>\n<table><tr><th>node</th>",
                    xsd_escaped(tree.file), percent(std::span(&tree, 1)), tree.shown(), tree.all(),
                    tree.is_proved ? ", of what verify proves possible"
                                   : ", of what is usual: verify cannot determine it");
    for (const std::string_view it : kAspects) text += fmt::format("<th class=\"a\">{}</th>", it);
    text += "<th>barriers</th><th></th></tr>\n";
    for (const CoveredNode& node : tree.nodes) text += page_row(node);
    text += "</table>\n";
  }
  return text + "</body></html>\n";
}

}  // namespace lockstep::host
