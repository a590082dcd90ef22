#include "study/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <semaphore>
#include <thread>
#include <vector>

#include "base/system/call_mark.h"
#include "run/plugin_thread.h"
#include "study/row_text.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kRowsPerChunk = 16;       // fewer if there are few rows for each thread
constexpr std::uint64_t kChunksPerThread = 1024;  // that may wait for an earlier one
constexpr std::chrono::milliseconds kWriteInterval{50};

struct Chunk {
  std::string lines;
  std::vector<RowResult> made;  // of which the first `rows` count
  std::size_t rows = 0;
  bool complete = true;  // false: nothing after it counts
  std::optional<StudyFault> fault;
  std::exception_ptr failure;  // unexpected
  std::vector<StudyOutOfRange> out_of_range;
  std::atomic<std::uint64_t> ready{0};  // 1 + the number of the chunk that is in it
};

// Shared by the threads.
class Workshop {
 public:
  explicit Workshop(const StudyWork& work)
      : work_(work),
        per_chunk_(std::clamp<std::uint64_t>(
            (work.last_row - work.first_row) / (std::uint64_t{4} * work.jobs), 1, kRowsPerChunk)),
        chunks_((work.last_row - work.first_row + per_chunk_ - 1) / per_chunk_),
        ring_(std::clamp<std::uint64_t>(chunks_, 1, kChunksPerThread * work.jobs)) {}

  std::optional<StudyFault> run();

 private:
  // However the writing ends, no thread waits for it any more.
  struct Dismissal {
    Workshop& shop;
    ~Dismissal() {
      shop.limit_ = 0;
      shop.written_ = shop.chunks_;
      shop.written_.notify_all();
    }
  };

  void work();
  void make_chunks();
  void make(std::uint64_t number, Chunk& chunk, std::optional<StudyRun>& run, std::uint64_t& cell);
  void write_ready();
  void write(Chunk& chunk);
  Chunk& slot(std::uint64_t number) { return ring_[number % ring_.size()]; }

  const StudyWork& work_;
  const std::uint64_t per_chunk_;  // rows
  const std::uint64_t chunks_;
  std::vector<Chunk> ring_;
  std::atomic<std::uint64_t> next_{0};
  std::atomic<std::uint64_t> limit_{std::numeric_limits<std::uint64_t>::max()};
  std::atomic<std::uint64_t> written_{0};  // chunks; also those that count for nothing
  std::counting_semaphore<> gone_{0};      // threads that have ended
  bool closed_ = false;                    // nothing is written any more
  std::optional<StudyFault> fault_;
  std::exception_ptr failure_;
};

void Workshop::work() {
  watch_this_thread(work_.hang_limit);
  make_chunks();
  gone_.release();
  leave_thread_to_plugins();
}

void Workshop::make_chunks() {
  std::optional<StudyRun> run;
  std::uint64_t cell = 0;
  for (;;) {
    const std::uint64_t number = next_.fetch_add(1, std::memory_order_relaxed);
    if (number >= chunks_ || number > limit_.load(std::memory_order_relaxed)) break;
    std::uint64_t written = written_.load(std::memory_order_acquire);
    while (number >= written + ring_.size()) {
      written_.wait(written, std::memory_order_acquire);
      written = written_.load(std::memory_order_acquire);
    }
    if (number > limit_.load(std::memory_order_relaxed)) break;
    Chunk& chunk = slot(number);
    try {
      make(number, chunk, run, cell);
    } catch (const std::exception&) {
      chunk.failure = std::current_exception();
      chunk.complete = false;
      chunk.lines.clear();  // the last may be half a line
      chunk.rows = 0;
    }
    if (!chunk.complete) {
      std::uint64_t limit = limit_.load();
      while (number < limit && !limit_.compare_exchange_weak(limit, number)) {
      }
    }
    chunk.ready.store(number + 1, std::memory_order_release);
  }
}

void Workshop::make(std::uint64_t number, Chunk& chunk, std::optional<StudyRun>& run,
                    std::uint64_t& cell) {
  const std::uint64_t first = work_.first_row + number * per_chunk_;
  const std::uint64_t last = std::min(work_.last_row, first + per_chunk_);
  const bool has_rows = work_.plan.rows != StudyRows::None;
  std::string cell_text;
  chunk.made.resize(per_chunk_);
  for (std::uint64_t index = first; index < last; ++index) {
    const StudyRow row = row_at(work_.plan, index);
    const StudyCell& at = work_.cells[row.cell];
    if (!run || cell != row.cell) {
      run.emplace(at, work_.measures, work_.plan.max_ticks, work_.stop_signal);
      cell = row.cell;
    }
    if (has_rows && (index == first || row.run < work_.plan.shard.of))
      cell_text = row_cell(work_.plan, cell);
    const std::uint64_t seed = run_seed(at.seed, seeding_cell(work_.plan, row.cell), row.run);
    CallMark::this_thread().set_run({row.cell, row.run, seed});
    const RunEnd end = run->run(seed);
    if (end.reason == StopReason::Fault) {
      chunk.fault = StudyFault{row, seed, *run->fault(), end.ticks};
    }
    if (end.reason == StopReason::Fault || end.reason == StopReason::Signal) {
      chunk.complete = false;
      return;
    }
    for (const OutOfRange& it : run->out_of_range()) chunk.out_of_range.push_back({row, it});
    RowResult& made = chunk.made[chunk.rows++];
    made.ticks = end.ticks;
    made.result = result_of(end);
    made.values.assign(work_.plan.columns.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < at.columns.size(); ++i)
      made.values[at.columns[i]] = run->values()[i];
    if (!has_rows) continue;
    append_row_beginning(cell_text, row.run, seed, chunk.lines);
    append_row_end(made, chunk.lines);
  }
}

void Workshop::write(Chunk& chunk) {
  if (closed_) return;
  if (!work_.write(chunk.lines, std::span(chunk.made).first(chunk.rows))) {
    closed_ = true;
    limit_ = 0;
  }
  for (const StudyOutOfRange& it : chunk.out_of_range) work_.out_of_range(it);
  fault_ = chunk.fault;
  failure_ = chunk.failure;
  closed_ |= !chunk.complete;
}

void Workshop::write_ready() {
  std::uint64_t number = written_.load();
  while (slot(number).ready.load(std::memory_order_acquire) == number + 1) {
    Chunk& chunk = slot(number);
    write(chunk);
    chunk.lines.clear();
    chunk.out_of_range.clear();
    chunk.rows = 0;
    written_.store(++number, std::memory_order_release);
  }
  written_.notify_all();
  if (work_.idle) work_.idle();
}

std::optional<StudyFault> Workshop::run() {
  std::vector<std::jthread> threads;
  for (unsigned job = 0; job < work_.jobs; ++job) threads.emplace_back([this] { work(); });
  for (unsigned alive = work_.jobs; alive > 0;) {
    if (gone_.try_acquire_for(kWriteInterval)) --alive;
    write_ready();
  }
  if (failure_ != nullptr) std::rethrow_exception(failure_);
  return fault_;
}

}  // namespace

std::optional<StudyFault> do_work(const StudyWork& work) {
  return Workshop(work).run();
}

}  // namespace lockstep::host
