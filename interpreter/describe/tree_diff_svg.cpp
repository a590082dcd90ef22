// Rows as in a list of files: a drawing of any tree is as wide as its texts, and is read from top
// to bottom.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/core/diagnostics.h"
#include "base/core/utf8.h"
#include "base/core/wording.h"
#include "describe/tree_diff.h"
#include "describe/xsd.h"

namespace lockstep::host {
namespace {

constexpr int kRow = 22, kIndent = 22, kTop = 64, kLeft = 16;
constexpr double kLetter = 7.3;  // of 12 px

struct Look {
  char sign;
  std::string_view fill, stroke, legend;
};
constexpr std::array<Look, 6> kLooks{{{'+', "#dafbe1", "#1a7f37", "new"},
                                      {'-', "#ffebe9", "#cf222e", "gone"},
                                      {'~', "#fff8c5", "#9a6700", "changed"},
                                      {'>', "#ddf4ff", "#0969da", "moved to here"},
                                      {'<', "#f6f8fa", "#0969da", "moved from here"},
                                      {' ', "#ffffff", "#6e7781", ""}}};

const Look& look_of(char sign) {
  return *std::ranges::find(kLooks, sign, &Look::sign);
}

int width_of(std::string_view text) {
  return static_cast<int>(static_cast<double>(columns(text)) * kLetter) + 14;
}

}  // namespace

std::string diff_as_svg(const TreeDiff& diff) {
  const auto rows = rows_of(diff);
  std::string body;
  int width = 420;
  std::vector<int> above{kTop};  // by depth: the row from which a line goes down
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DiffRow& row = rows[i];
    const Look& look = look_of(row.sign);
    const int x = kLeft + static_cast<int>(row.depth) * kIndent;
    const int y = kTop + static_cast<int>(i) * kRow;
    const std::string text = text_of(diff, row);
    const int row_width = width_of(text);
    width = std::max(width, x + row_width + kLeft);
    above.resize(row.depth + 1);
    if (row.depth > 0) {
      body += fmt::format("<path d=\"M{} {}V{}H{}\" class=\"line\"/>\n", x - 12,
                          above[row.depth - 1] + kRow - 3, y + kRow / 2, x);
    }
    above[row.depth] = y;
    const bool is_node = row.new_node != kNoNode || row.old_node != kNoNode;
    if (is_node) {
      body += fmt::format(
          "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"4\" fill=\"{}\" "
          "stroke=\"{}\"{}/>\n",
          x, y + 1, row_width, kRow - 4, look.fill, look.stroke,
          row.sign == '<' || row.sign == '-' ? " stroke-dasharray=\"4 2\"" : "");
    }
    body += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", x + 7, y + 15,
                        row.sign == '-' ? " class=\"gone\"" : "", xsd_escaped(text));
  }
  std::string legend;
  int x = kLeft;
  for (const Look& it : kLooks) {
    if (it.legend.empty()) continue;
    legend += fmt::format(
        "<rect x=\"{}\" y=\"34\" width=\"12\" height=\"12\" rx=\"2\" fill=\"{}\" stroke=\"{}\"/>"
        "<text x=\"{}\" y=\"45\">{}</text>\n",
        x, it.fill, it.stroke, x + 18, it.legend);
    x += 30 + width_of(it.legend);
  }
  const std::string title =
      fmt::format("{} → {}", printable(diff.sides[0].name), printable(diff.sides[1].name));
  width = std::max({width, x, kLeft + width_of(title)});
  const int height = kTop + static_cast<int>(rows.size()) * kRow + 12;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
             "viewBox=\"0 0 {0} {1}\">\n"
             "<style>text{{font:12px ui-monospace,monospace;fill:#1f2328;white-space:pre}}"
             ".gone{{text-decoration:line-through}}.line{{fill:none;stroke:#afb8c1}}"
             ".title{{font-weight:bold}}</style>\n"
             "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
             "<text x=\"{2}\" y=\"20\" class=\"title\">{3}</text>\n",
             width, height, kLeft, xsd_escaped(title)) +
         legend + body + "</svg>\n";
}

std::string diff_as_page(const TreeDiff& diff) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0} → {1}</title>\n"
      "<style>body{{font-family:sans-serif;margin:16px}}pre{{line-height:1.5}}</style></head>\n"
      "<body>\n{2}<pre>{3}</pre>\n</body></html>\n",
      xsd_escaped(printable(diff.sides[0].name)), xsd_escaped(printable(diff.sides[1].name)),
      diff_as_svg(diff), xsd_escaped(diff.same() ? "no difference" : diff_as_text(diff, false)));
}

}  // namespace lockstep::host
