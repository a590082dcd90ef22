// The totals of a study without rows: cells.jsonl has a line for each cell whose runs are all made,
// cell.json the same for the one that is being made.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/core/clock.h"
#include "base/system/descriptors.h"
#include "base/system/output_file.h"
#include "study/result_file.h"
#include "study/totals_reader.h"
#include "study/totals_text.h"

namespace lockstep::host {
namespace {

class TotalsFile final : public ResultFile {
 public:
  explicit TotalsFile(const ResultPlace& place)
      : place_(place), runs_(runs_of_part(place.plan)), open_(place.plan) {}

  Result<RowSequence> take_over() override;
  Result<void> add(std::string_view lines, std::span<const RowResult> rows) override;
  Result<void> add(const CellTotals& cell) override {
    open_ = cell;
    return end_cell();
  }
  Result<void> save() override;

 private:
  static constexpr Nanoseconds kSaveInterval = std::chrono::seconds(10);

  std::string path(const char* name) const { return place_.directory + '/' + name; }
  Result<void> take_over_open_cell();
  Result<void> end_cell();
  Result<void> cannot_write() const {
    return problem(fmt::format("cannot write '{}': {}", path("cells.jsonl"), std::strerror(errno)));
  }

  ResultPlace place_;
  std::uint64_t runs_;  // of each cell
  std::uint64_t cell_ = 0;
  CellTotals open_;  // of the cell
  Nanoseconds saved_ = monotonic_now();
};

Result<RowSequence> TotalsFile::take_over() {
  TotalsReader reader(path("cells.jsonl"), place_.plan);
  while (reader.next()) continue;
  if (!reader.error().empty()) return problem(reader.error());
  if (ftruncate(place_.file, static_cast<off_t>(reader.bytes())) != 0)
    return tl::unexpected(cannot_write().error());
  cell_ = reader.cells();
  return take_over_open_cell().map([&] {
    RowSequence rows(place_.plan);
    rows.skip(cell_ * runs_ + open_.results().runs);
    return rows;
  });
}

Result<void> TotalsFile::take_over_open_cell() {
  std::ifstream in(path("cell.json"), std::ios::binary);
  std::ostringstream text;
  if (!in.is_open() || !(text << in.rdbuf())) return {};
  // A kill between the line of a cell and the end of this file leaves it behind.
  if (cell_ > 0 && text.str().starts_with(fmt::format("{{\"cell\":{},", cell_ - 1))) return {};
  auto open = read_totals_line(text.str(), place_.plan, cell_, false);
  if (!open) return problem(fmt::format("'{}': {}", path("cell.json"), open.error().message));
  open_ = std::move(*open);
  return open_.results().runs == runs_ ? end_cell() : Result<void>();
}

Result<void> TotalsFile::end_cell() {
  if (!write_all(place_.file, totals_line(cell_, open_))) return cannot_write();
  unlink(path("cell.json").c_str());
  open_ = CellTotals(place_.plan);
  ++cell_;
  return {};
}

Result<void> TotalsFile::add(std::string_view, std::span<const RowResult> rows) {
  Result<void> written;
  for (const RowResult& row : rows) {
    open_.add(row);
    if (open_.results().runs == runs_) written = end_cell();
    if (!written) return written;
  }
  return monotonic_now() - saved_ < kSaveInterval ? written : save();
}

Result<void> TotalsFile::save() {
  saved_ = monotonic_now();
  if (open_.results().runs == 0) return {};
  return write_output(path("cell.json"), totals_line(cell_, open_));
}

}  // namespace

std::unique_ptr<ResultFile> totals_file(const ResultPlace& place) {
  return std::make_unique<TotalsFile>(place);
}

}  // namespace lockstep::host
