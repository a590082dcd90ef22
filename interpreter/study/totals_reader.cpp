#include "study/totals_reader.h"

#include <fmt/format.h>

#include <filesystem>

#include "study/totals_text.h"

namespace lockstep::host {

TotalsReader::TotalsReader(const std::string& path, const StudyPlan& plan)
    : plan_(plan), path_(path) {
  std::error_code unknown;
  const auto kind = std::filesystem::status(path, unknown).type();
  if (kind == std::filesystem::file_type::not_found) return;  // no cells yet
  if (kind == std::filesystem::file_type::regular) file_.open(path, std::ios::binary);
  if (!file_.is_open()) error_ = fmt::format("cannot read '{}'", path);
}

std::optional<CellTotals> TotalsReader::next() {
  std::string line;
  if (!error_.empty() || !std::getline(file_, line) || file_.eof()) return std::nullopt;
  line += '\n';
  bytes_ += line.size();
  if (cells_ == cell_count(plan_)) {
    error_ = fmt::format("'{}' has more cells than its study.json lists", path_);
    return std::nullopt;
  }
  auto totals = read_totals_line(std::move(line), plan_, cells_, true);
  if (!totals) {
    error_ = fmt::format("'{}', line {}: {}", path_, cells_ + 1, totals.error().message);
    return std::nullopt;
  }
  ++cells_;
  return std::move(*totals);
}

std::string TotalsReader::incomplete() const {
  if (!error_.empty() || cells_ == cell_count(plan_)) return error_;
  return fmt::format("'{}' has {}", path_, count_text());
}

std::string TotalsReader::count_text() const {
  return fmt::format("{} of {} cells", cells_, cell_count(plan_));
}

}  // namespace lockstep::host
