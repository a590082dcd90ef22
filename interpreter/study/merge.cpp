#include "study/merge.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "base/core/wording.h"
#include "study/folder.h"
#include "study/plan_json.h"
#include "study/row_reader.h"
#include "study/totals_reader.h"

namespace lockstep::host {
namespace {

std::string not_finished(const std::string& part, const std::string& count) {
  return fmt::format("'{}' is not finished: it has {}; continue it with --resume", part, count);
}

class Merger {
 public:
  Result<void> add(const std::string& directory);
  Result<void> check_complete() const;
  Result<void> copy(StudyFolder& out, int (*stop_signal)()) {
    return whole_.rows == StudyRows::None ? add_totals(out, stop_signal)
                                          : copy_rows(out, stop_signal);
  }
  const StudyPlan& whole() const { return whole_; }

 private:
  struct Part {
    std::string directory;
    StudyPlan plan;
    std::unique_ptr<RowReader> rows;  // one of these
    std::unique_ptr<TotalsReader> totals;
  };
  Result<void> next_row(Part& part, std::string& lines);
  Result<void> copy_rows(StudyFolder& out, int (*stop_signal)());
  Result<void> add_totals(StudyFolder& out, int (*stop_signal)());

  StudyPlan whole_;
  std::uint64_t of_ = 0;  // so many parts there are to be
  std::map<std::uint64_t, Part> parts_;
};

Result<void> Merger::add(const std::string& directory) {
  const StudyFolder folder(directory);
  auto plan = folder.read_plan();
  if (!plan) return tl::unexpected(std::move(plan.error()));
  const auto [number, of] = plan->shard;
  if (parts_.empty()) {
    whole_ = *plan;
    whole_.shard = {};
    of_ = of;
  }
  if (of != of_)
    return problem(
        fmt::format("'{}' is one of {} parts, the ones before it of {}", directory, of, of_));
  if (const auto key = first_difference(whole_, *plan, false); !key.empty()) {
    return problem(
        fmt::format("'{}' is a part of another study: its '{}' differs", directory, key));
  }
  const auto [place, is_new] = parts_.try_emplace(number);
  Part& part = place->second;
  if (!is_new) {
    return problem(
        fmt::format("'{}' and '{}' are both part {} of {}", part.directory, directory, number, of));
  }
  part.directory = directory;
  part.plan = std::move(*plan);
  const std::string file = folder.file(result_file_name(part.plan.rows));
  if (part.plan.rows == StudyRows::None)
    part.totals = std::make_unique<TotalsReader>(file, part.plan);
  else
    part.rows = std::make_unique<RowReader>(file, part.plan);
  return {};
}

Result<void> Merger::check_complete() const {
  constexpr std::size_t kMostNamed = 10;
  const std::uint64_t missing = of_ - parts_.size();
  if (missing == 0) return {};
  std::vector<std::uint64_t> named;
  for (std::uint64_t number = 1; number <= of_ && named.size() < kMostNamed; ++number) {
    if (!parts_.contains(number)) named.push_back(number);
  }
  return problem(fmt::format("of {} parts these are missing: {}{}", of_, joined(named, ", "),
                             missing > named.size() ? ", …" : ""));
}

Result<void> Merger::next_row(Part& part, std::string& lines) {
  const std::string_view line = part.rows->next();
  lines += line;
  if (!line.empty()) return {};
  if (!part.rows->error().empty()) return problem(part.rows->error());
  return problem(not_finished(part.directory, part.rows->count_text()));
}

Result<void> Merger::copy_rows(StudyFolder& out, int (*stop_signal)()) {
  constexpr std::size_t kFull = 1u << 16u;
  std::string lines;
  RowSequence rows(whole_);
  while (const auto row = rows.next()) {
    Part& part = parts_.at(row->run % of_ + 1);
    if (auto read = next_row(part, lines); !read) return read;
    rows.add(part.rows->row());
    if (lines.size() < kFull && rows.next()) continue;
    if (auto written = out.append(lines, {}); !written) return written;
    if (stop_signal() != 0) return problem("interrupted");
    lines.clear();
  }
  return out.save();
}

Result<void> Merger::add_totals(StudyFolder& out, int (*stop_signal)()) {
  for (std::uint64_t cell = 0; cell < cell_count(whole_); ++cell) {
    CellTotals all(whole_);
    for (auto& [number, part] : parts_) {
      const auto totals = part.totals->next();
      if (!part.totals->error().empty()) return problem(part.totals->error());
      if (!totals) return problem(not_finished(part.directory, part.totals->count_text()));
      all.add(*totals);
    }
    if (auto written = out.append(all); !written) return written;
    if (stop_signal() != 0) return problem("interrupted");
  }
  return {};
}

}  // namespace

Result<MergedStudy> merge_studies(std::span<const std::string> parts, const std::string& out,
                                  int (*stop_signal)()) {
  Merger merger;
  Result<void> complete;
  for (const std::string& part : parts) {
    complete = complete.and_then([&] { return merger.add(part); });
  }
  StudyFolder folder(out);
  const auto begun = complete.and_then([&] { return merger.check_complete(); }).and_then([&] {
    return folder.begin(merger.whole(), false);
  });
  if (!begun) return tl::unexpected(begun.error());
  auto rows =
      merger.copy(folder, stop_signal).and_then([&] { return folder.finish(merger.whole()); });
  if (!rows) folder.discard(merger.whole());
  return rows.map([&](auto& all) { return MergedStudy{merger.whole(), std::move(all)}; });
}

}  // namespace lockstep::host
