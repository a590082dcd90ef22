#include "base/terminal/text_table.h"

#include <algorithm>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kGap = 2;

std::vector<std::size_t> widths_of(const std::vector<TableRow>& rows) {
  std::vector<std::size_t> widths;
  for (const TableRow& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(row[i]));
  }
  return widths;
}

// The columns up to `left`, and those from `begin` to `end`.
std::string part_of(const std::vector<TableRow>& rows, const std::vector<std::size_t>& widths,
                    std::size_t left, std::size_t begin, std::size_t end) {
  std::string text;
  for (const TableRow& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < std::min(row.size(), end); ++i) {
      if (i >= left && i < begin) continue;
      const std::string blanks(widths[i] - columns(row[i]), ' ');
      if (i != 0) line.append(kGap, ' ');
      line += i < left ? row[i] + blanks : blanks + row[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace

std::string text_table(const std::vector<TableRow>& rows, std::size_t left, std::size_t width) {
  const auto widths = widths_of(rows);
  left = std::min(left, widths.size());
  std::size_t names = 0;
  for (std::size_t i = 0; i < left; ++i) names += widths[i] + kGap;
  std::string text;
  std::size_t begin = left;
  do {
    std::size_t end = begin, used = names;
    while (end < widths.size() && (end == begin || used + widths[end] <= width)) {
      used += widths[end++] + kGap;
    }
    if (!text.empty()) text += '\n';
    text += part_of(rows, widths, left, begin, end);
    begin = end;
  } while (begin < widths.size());
  return text;
}

}  // namespace lockstep::host
