// Measures runs of one tree, one after the other, with the requested measures.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "judge/measure/measure.h"
#include "judge/measure/synchronized_ticks.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

class Measuring {
 public:
  // `specs` must outlive this, `tree` need not. If a measure names something that the tree does not
  // have, error() reports it.
  Measuring(const Shape& tree, std::span<const MeasureSpec> specs);

  const std::string& error() const { return error_; }

  // One column for each measure; for a measure of each parallel, one for each parallel.
  struct Column {
    const MeasureSpec* spec;
    std::string node;  // the path; the tree's id for what is of the run
  };
  std::span<const Column> columns() const { return columns_; }

  // What the Moments must have.
  const AskedOfRun& asked() const { return asked_; }

  void reset();  // for the next run
  void join(Joint joint);
  void after_tick(const Moment& moment);
  // NaN: it was not reached.
  double value(std::size_t column, const EndView& end) const;
  double gap(std::size_t column) const { return accumulators_[column]->gap(); }

 private:
  void add(const MeasureSpec& spec, std::string node, const MeasureTarget& target);
  void add_parallels(const MeasureSpec& spec, const Shape& tree);
  void add_child(const MeasureSpec& spec, const Shape& tree);
  void add_pair(const MeasureSpec& spec, const Shape& tree);
  void add_user(const MeasureSpec& spec, const Shape& tree);
  void add_pool(const MeasureSpec& spec, const Shape& tree);
  void add_node(const MeasureSpec& spec, const Shape& tree);
  void add_entry(const MeasureSpec& spec, const Shape& tree);
  // Nothing: there is an error.
  std::optional<std::size_t> found(Result<std::size_t> place);
  MeasureTarget target_of(const Shape& tree, NodeIndex parallel);

  std::vector<Column> columns_;
  std::vector<std::unique_ptr<Accumulator>> accumulators_;  // of each column
  AskedOfRun asked_;
  std::vector<SynchronizedTicks> parallels_;
  std::vector<SynchronizedTick> ticks_;      // of these
  std::map<NodeIndex, std::size_t> places_;  // of the parallels, in `asked_`
  bool needs_flags_ = false;                 // which children are held
  std::string error_;
};

}  // namespace lockstep::host
