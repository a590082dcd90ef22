#include "run/checkpoint/checkpoint_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/system/boot_id.h"
#include "base/system/own_thread.h"
#include "engine/tree.h"
#include "run/checkpoint/run_bytes.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

// A run in which only time passes is synced as often.
constexpr Nanoseconds kSyncOfTime = std::chrono::seconds(1);

Nanoseconds wall_time() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);  // no system call
  return std::chrono::seconds(now.tv_sec) + Nanoseconds(now.tv_nsec);
}

bool is_action(const Tree& tree, NodeIndex node) {
  return tree.labels[node].type->category == NodeCategory::Action;
}

}  // namespace

Nanoseconds CheckpointWriter::pause_of(Nanoseconds period) {
  constexpr Nanoseconds kOften = std::chrono::milliseconds(1), kSeldom = kOften * 10;
  return std::clamp(period / 2, kOften, kSeldom);
}

Nanoseconds CheckpointWriter::longest_sync(Nanoseconds sync) {
  return std::max(sync, kSyncOfTime);
}

CheckpointWriter::CheckpointWriter(std::unique_ptr<CheckpointFile> file, CheckpointOptions options)
    : options_(std::move(options)), file_(std::move(file)) {}

CheckpointWriter::~CheckpointWriter() {
  stop();
}

bool CheckpointWriter::begin(Ticker& ticker, const CheckpointFacts& facts, std::uint64_t ticks,
                             std::uint32_t resumes, std::span<const std::uint32_t> set) {
  head_.ticks = ticks;
  head_.set.assign(set.begin(), set.end());
  kept_.store(ticks, std::memory_order_release);
  head_.resumes = resumes;
  head_.boot = boot_id();
  running_.reserve(ticker.tree().nodes.size());
  note_results(ticker);
  note_writes(ticker);
  Snapshot first;
  take_leaves(ticker);
  const bool has_state = fill(first, ticker);
  if (!has_state && !ticker.faulted()) return false;
  std::string bytes;
  append_facts(facts, bytes);
  // A leaf that failed when it was asked to continue: nothing goes on from here.
  if (!has_state) first.bytes = last_bytes(Checkpoint::Kind::Ended, {});
  if (!file_->begin(std::move(bytes), first.bytes)) return false;
  durable_.store(ticker.tick_number(), std::memory_order_release);
  snapshots_.for_each([&](Snapshot& it) { it.bytes.reserve(2 * first.bytes.size()); });
  thread_ = own_thread([this] {
    try {
      write_until_stopped();
    } catch (...) {  // who waits for it must not wait for ever
      failed_.store(true, std::memory_order_release);
      done_.ring();
      throw;
    }
  });
  return true;
}

// Before: what runs. After: whether one of these has a result.
void CheckpointWriter::note_results(const Ticker& ticker) {
  if (head_.resumes == 0) return;
  const bool has_one = std::ranges::any_of(running_, [&](NodeIndex node) {
    return has_ended(ticker.status(node)) || ticker.ended_after_success(node);
  });
  if (has_one) head_.resumes = 0;
  running_.clear();
  const Tree& tree = ticker.tree();
  for (NodeIndex node = 0; node < tree.nodes[0].end; ++node) {
    if (ticker.status(node) == Status::Running && is_action(tree, node)) running_.push_back(node);
  }
}

void CheckpointWriter::note_writes(const Ticker& ticker) {
  const std::vector<Entry>& entries = ticker.parts().entries;
  writes_.resize(entries.size());
  std::ranges::transform(entries, writes_.begin(), &Entry::changes);
}

// Between two ticks, only others write entries.
void CheckpointWriter::find_set(const Ticker& ticker) {
  const std::vector<Entry>& entries = ticker.parts().entries;
  for (std::uint32_t slot = 0; slot < entries.size(); ++slot) {
    const bool is_known = std::ranges::find(head_.set, slot) != head_.set.end();
    if (!is_known && entries[slot].changes() != writes_[slot]) head_.set.push_back(slot);
  }
}

void CheckpointWriter::take_leaves(Ticker& ticker) {
  head_.time = ticker.now();
  if (head_.kind == Checkpoint::Kind::Unfinished) ticker.save_leaves(leaves_);
}

// False: the run has no state that can be kept.
bool CheckpointWriter::fill(Snapshot& snapshot, const Ticker& ticker) {
  const bool goes_on = head_.kind == Checkpoint::Kind::Unfinished;
  if (goes_on && ticker.faulted()) return false;
  const RunParts parts = ticker.parts();
  if (const auto entry = goes_on ? entry_with_object(parts, ticker.tree()) : std::nullopt)
      [[unlikely]] {
    lose(fmt::format("the entry '{}' holds an object, which no checkpoint has", *entry));
    return false;
  }
  head_.written = wall_time();
  if (options_.team != nullptr) options_.team->keep_rounds(head_.rounds);
  if (options_.properties != nullptr) options_.properties->keep(head_.properties);
  snapshot.bytes.clear();
  append_head(head_, snapshot.bytes);
  snapshot.lasting = snapshot.bytes.size();
  if (goes_on) snapshot.lasting += append_bytes(parts, leaves_, snapshot.bytes);
  snapshot.ticks = head_.ticks;
  snapshot.number = ++number_;
  snapshot.tick = ticker.tick_number();
  snapshot.commit = ticker.last_commit();
  return true;
}

void CheckpointWriter::after_tick(Ticker& ticker, std::uint64_t ticks, bool is_over) {
  if (is_lost()) return;
  head_.ticks = ticks;
  head_.kind = is_over ? Checkpoint::Kind::Ended : Checkpoint::Kind::Unfinished;
  note_results(ticker);
  note_writes(ticker);
  head_.set.clear();
  if (is_over) head_.resumes = 0;
  take_leaves(ticker);
  publish(ticker, !options_.real_time);
}

void CheckpointWriter::between_ticks(const Ticker& ticker, bool waits) {
  if (is_lost() || head_.kind != Checkpoint::Kind::Unfinished) return;
  find_set(ticker);
  publish(ticker, waits || !options_.real_time);
}

bool CheckpointWriter::is_lost() {
  if (lost_.empty() && failed_.load(std::memory_order_acquire)) lose(file_->error());
  return !lost_.empty();
}

void CheckpointWriter::publish(const Ticker& ticker, bool waits) {
  if (!fill(snapshots_.back(), ticker)) return;
  snapshots_.publish();
  if (!waits) return;
  flush();
  if (failed_.load(std::memory_order_acquire)) lose(file_->error());
}

// Once: a run that goes on must not be resumed from an old state.
void CheckpointWriter::lose(const std::string& why) {
  lost_ = why.empty() ? "out of memory" : why;
  durable_.store(UINT32_MAX, std::memory_order_release);
  if (!thread_.joinable()) return;
  stop();
  file_->write_last(last_bytes(Checkpoint::Kind::Lost, lost_));
  if (options_.on_error) options_.on_error(lost_);
}

void CheckpointWriter::end(std::uint64_t ticks, Nanoseconds time) {
  stop();
  head_.ticks = ticks;
  head_.time = time;
  file_->write_last(last_bytes(Checkpoint::Kind::Ended, {}));
}

std::string CheckpointWriter::error() const {
  return lost_.empty() && !thread_.joinable() ? file_->error() : lost_;
}

std::string CheckpointWriter::last_bytes(Checkpoint::Kind kind, const std::string& note) const {
  Checkpoint last = head_;
  last.kind = kind;
  if (kind == Checkpoint::Kind::Lost) last.ticks = kept();
  last.note = note;
  last.written = wall_time();
  std::string bytes;
  append_head(last, bytes);
  return bytes;
}

void CheckpointWriter::stop() {
  if (!thread_.joinable()) return;
  stopping_.store(true, std::memory_order_release);
  work_.ring();
  thread_.join();
}

void CheckpointWriter::flush() {
  while (true) {
    const std::uint32_t seen = done_.rung();
    if (failed_.load(std::memory_order_acquire) ||
        written_.load(std::memory_order_acquire) == number_) {
      return;
    }
    work_.ring();
    done_.wait(seen, options_.sync);
  }
}

// A caller that waits rings it. Otherwise it looks twice a tick, but not too often.
void CheckpointWriter::write_until_stopped() {
  const Nanoseconds pause = options_.real_time ? pause_of(options_.period) : kSyncOfTime;
  std::string lasting;     // of the last one that was written
  bool is_synced = false;  // but for the time
  Nanoseconds synced_at = monotonic_now();
  while (true) {
    const std::uint32_t seen = work_.rung();
    const bool stops = stopping_.load(std::memory_order_acquire);
    bool is_good = true;
    if (snapshots_.take()) {
      const Snapshot& it = snapshots_.front();
      is_good = file_->write(it.bytes);
      const std::string_view now = std::string_view(it.bytes).substr(it.lasting);
      is_synced = is_synced && now == lasting;
      lasting = now;
      if (is_good) kept_.store(snapshots_.front().ticks, std::memory_order_release);
    }
    const Nanoseconds since = monotonic_now() - synced_at;
    if (stops || snapshots_.front().commit > durable() ||
        since >= (is_synced ? longest_sync(options_.sync) : options_.sync)) {
      is_good = is_good && file_->sync();
      is_synced = true;
      synced_at = monotonic_now();
      if (is_good && snapshots_.front().number != 0) {
        durable_.store(snapshots_.front().tick, std::memory_order_release);
      }
    }
    if (is_good) written_.store(snapshots_.front().number, std::memory_order_release);
    if (!is_good) failed_.store(true, std::memory_order_release);
    done_.ring();
    if (stops || !is_good) return;
    work_.wait(seen, pause);
  }
}

}  // namespace lockstep::host
