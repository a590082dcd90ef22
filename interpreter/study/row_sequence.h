// The order of the rows of a study. With a precision, the rows of a cell decide after which of them
// the next cell begins: a function of the rows before, so it is the same for whoever makes or reads
// them.
#pragma once

#include <optional>

#include "study/cell_values.h"
#include "study/plan.h"

namespace lockstep::host {

class RowSequence {
 public:
  // `plan` must outlive the sequence.
  explicit RowSequence(const StudyPlan& plan);

  // The row that comes next, and with the number `first` in row_at(). Nothing: all are there.
  std::optional<StudyRow> next() const;
  // The row that came next.
  void add(const RowResult& row);
  // The next rows, so many, are there. Not with a precision, which would have to know them.
  void skip(std::uint64_t rows) {
    count_ += rows;
    first_ += rows;
  }

  // The rows from `first` to before `last` are needed, whatever their values.
  std::uint64_t first() const { return first_; }
  std::uint64_t last() const { return last_; }

  std::uint64_t count() const { return count_; }  // so far
  // Whether the number of all rows depends on those to come.
  bool is_open() const { return plan_->precision && next(); }
  // All together, at most.
  std::uint64_t most() const { return count_ + row_count(*plan_) - first_; }

 private:
  bool has_enough(std::uint64_t cell) const;

  const StudyPlan* plan_;
  CellValues values_;  // of the cell so far; with a precision only
  std::uint64_t first_ = 0, last_ = 0, count_ = 0;
};

}  // namespace lockstep::host
