// The file in a study's directory with the results of its runs, so far: their rows, plain or
// compressed, or the totals of each cell. What is in it when all runs are made is a function of the
// runs alone, not of interruptions.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "study/cell_totals.h"
#include "study/plan.h"
#include "study/row_sequence.h"
#include "study/row_text.h"

namespace lockstep::host {

// The parts that results of all kinds share.
struct ResultPlace {
  const StudyPlan& plan;
  std::string directory;
  int file = -1;  // the file, open for reading and appending; it is not closed
};

class ResultFile {
 public:
  virtual ~ResultFile() = default;

  // Continues after the results that are there; what a kill left half-written is cut off.
  virtual Result<RowSequence> take_over() = 0;
  // The next results: as lines of runs.csv and as numbers.
  virtual Result<void> add(std::string_view lines, std::span<const RowResult> rows) = 0;
  // The next results, of a whole cell; in a file of totals only.
  virtual Result<void> add(const CellTotals&) { return problem("it has rows"); }
  // Nothing that was added is lost from here on.
  virtual Result<void> save() { return {}; }
};

std::string_view result_file_name(StudyRows rows);
std::unique_ptr<ResultFile> make_result_file(const ResultPlace& place);

// For each kind.
std::unique_ptr<ResultFile> plain_rows(const ResultPlace& place);
std::unique_ptr<ResultFile> compressed_rows(const ResultPlace& place);
std::unique_ptr<ResultFile> totals_file(const ResultPlace& place);

}  // namespace lockstep::host
