#include "study/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>

#include "study/plan_json.h"
#include "study/row_reader.h"

namespace lockstep {
namespace {

class Merger {
 public:
  // "" when the part has its place.
  std::string add(const std::string& directory);
  std::string missing() const;
  std::string copy_rows(StudyFolder& out, int (*stop_signal)());
  const StudyPlan& whole() const { return whole_; }

 private:
  struct Part {
    std::string directory;
    StudyPlan plan;
    std::unique_ptr<RowReader> reader;
  };
  std::string next_row(Part& part, std::string& lines);

  StudyPlan whole_;
  std::uint64_t of_ = 0;  // so many parts there are to be
  std::map<std::uint64_t, Part> parts_;
};

std::string Merger::add(const std::string& directory) {
  StudyFolder folder(directory);
  auto plan = folder.read_plan();
  if (!plan) return folder.error();
  const auto [number, of] = plan->shard;
  if (parts_.empty()) {
    whole_ = *plan;
    whole_.shard = {};
    of_ = of;
  }
  if (of != of_)
    return fmt::format("'{}' is one of {} parts, the ones before it of {}", directory, of, of_);
  if (const auto key = first_difference(whole_, *plan, false); !key.empty()) {
    return fmt::format("'{}' is a part of another study: its '{}' differs", directory, key);
  }
  const auto [place, is_new] = parts_.try_emplace(number);
  Part& part = place->second;
  if (!is_new) {
    return fmt::format("'{}' and '{}' are both part {} of {}", part.directory, directory, number,
                       of);
  }
  part.directory = directory;
  part.plan = std::move(*plan);
  part.reader = std::make_unique<RowReader>(folder.file("runs.csv"), part.plan);
  return {};
}

std::string Merger::missing() const {
  constexpr std::size_t kMostNamed = 10;
  const std::uint64_t missing = of_ - parts_.size();
  if (missing == 0) return {};
  std::vector<std::uint64_t> named;
  for (std::uint64_t number = 1; number <= of_ && named.size() < kMostNamed; ++number) {
    if (!parts_.contains(number)) named.push_back(number);
  }
  return fmt::format("of {} parts these are missing: {}{}", of_, fmt::join(named, ", "),
                     missing > named.size() ? ", …" : "");
}

std::string Merger::next_row(Part& part, std::string& lines) {
  const std::string_view line = part.reader->next();
  lines += line;
  if (!line.empty()) return {};
  if (!part.reader->error().empty()) return part.reader->error();
  return fmt::format("'{}' is not finished: it has {}; continue it with --resume", part.directory,
                     part.reader->count_text());
}

std::string Merger::copy_rows(StudyFolder& out, int (*stop_signal)()) {
  constexpr std::size_t kFull = 1u << 16u;
  std::string lines;
  RowSequence rows(whole_);
  while (const auto row = rows.next()) {
    Part& part = parts_.at(row->run % of_ + 1);
    if (auto error = next_row(part, lines); !error.empty()) return error;
    rows.add(part.reader->row());
    if (lines.size() < kFull && rows.next()) continue;
    if (!out.append(lines)) return out.error();
    if (stop_signal() != 0) return "interrupted";
    lines.clear();
  }
  return {};
}

}  // namespace

Result<MergedStudy> merge_studies(std::span<const std::string> parts, const std::string& out,
                                  int (*stop_signal)()) {
  const auto fail = [](std::string message) { return tl::unexpected(Problem{std::move(message)}); };
  Merger merger;
  for (const std::string& part : parts) {
    if (auto error = merger.add(part); !error.empty()) return fail(std::move(error));
  }
  if (auto missing = merger.missing(); !missing.empty()) return fail(std::move(missing));
  StudyFolder folder(out);
  if (!folder.begin(merger.whole(), false)) return fail(folder.error());
  std::string error = merger.copy_rows(folder, stop_signal);
  auto rows = error.empty() ? folder.finish(merger.whole()) : std::nullopt;
  if (rows) return MergedStudy{merger.whole(), std::move(*rows)};
  if (error.empty()) error = folder.error();
  folder.discard();
  return fail(std::move(error));
}

}  // namespace lockstep
