#include "study/merge.h"

#include <fmt/format.h>

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
  std::string copy_rows(StudyFolder& out);
  const StudyPlan& whole() const { return whole_; }

 private:
  struct Part {
    std::string directory;
    StudyPlan plan;
    std::unique_ptr<RowReader> reader;
  };
  std::string next_row(Part& part, std::string& lines);

  StudyPlan whole_;
  std::vector<std::unique_ptr<Part>> parts_;  // by number
};

std::string Merger::add(const std::string& directory) {
  StudyFolder folder(directory);
  auto plan = folder.read_plan();
  if (!plan) return folder.error();
  const auto [number, of] = plan->shard;
  if (parts_.empty()) {
    whole_ = *plan;
    whole_.shard = {};
    if (of > whole_.runs)
      return fmt::format("'{}' is one of {} parts of {} runs", directory, of, whole_.runs);
    parts_.resize(of);
  }
  if (of != parts_.size()) {
    return fmt::format("'{}' is one of {} parts, the ones before it of {}", directory, of,
                       parts_.size());
  }
  if (const auto key = first_difference(whole_, *plan, false); !key.empty()) {
    return fmt::format("'{}' is a part of another study: its '{}' differs", directory, key);
  }
  auto& place = parts_[number - 1];
  if (place) {
    return fmt::format("'{}' and '{}' are both part {} of {}", place->directory, directory, number,
                       of);
  }
  place = std::make_unique<Part>(Part{directory, std::move(*plan), nullptr});
  place->reader = std::make_unique<RowReader>(folder.file("runs.csv"), place->plan);
  return {};
}

std::string Merger::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!parts_[i]) numbers.push_back(i + 1);
  }
  if (numbers.empty()) return {};
  return fmt::format("of {} parts these are missing: {}", parts_.size(), fmt::join(numbers, ", "));
}

std::string Merger::next_row(Part& part, std::string& lines) {
  const std::string_view line = part.reader->next();
  lines += line;
  if (!line.empty()) return {};
  if (!part.reader->error().empty()) return part.reader->error();
  return fmt::format("'{}' is not finished: it has {} of {} runs; go on with it by --resume",
                     part.directory, part.reader->rows(), row_count(part.plan));
}

std::string Merger::copy_rows(StudyFolder& out) {
  constexpr std::size_t kFull = 1u << 16u;
  std::string lines;
  const std::uint64_t rows = row_count(whole_);
  for (std::uint64_t row = 0; row < rows; ++row) {
    const std::uint64_t run = row_at(whole_, row).run;
    if (auto error = next_row(*parts_[run % parts_.size()], lines); !error.empty()) return error;
    if (lines.size() < kFull && row + 1 < rows) continue;
    if (!out.append(lines)) return out.error();
    lines.clear();
  }
  return {};
}

}  // namespace

std::optional<std::vector<SummaryRow>> merge_studies(std::span<const std::string> parts,
                                                     const std::string& out, StudyPlan& plan,
                                                     std::string& error) {
  Merger merger;
  for (const std::string& part : parts) {
    error = merger.add(part);
    if (!error.empty()) return std::nullopt;
  }
  error = merger.missing();
  if (!error.empty()) return std::nullopt;
  plan = merger.whole();
  StudyFolder folder(out);
  if (!folder.begin(plan, false)) {
    error = folder.error();
    return std::nullopt;
  }
  error = merger.copy_rows(folder);
  if (!error.empty()) return std::nullopt;
  auto rows = folder.finish(plan);
  error = folder.error();
  return rows;
}

}  // namespace lockstep
