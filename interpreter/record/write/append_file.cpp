#include "record/write/append_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <new>
#include <utility>

#include "base/core/clock.h"
#include "base/system/own_thread.h"
#include "record/json_lines.h"
#include "record/live/packet_printer.h"
#include "record/part_names.h"

namespace lockstep::host {
namespace {

// For emergency_flush(). A process has one recording, rarely more; those that find no place here
// are not saved in an emergency.
std::array<std::atomic<AppendFile*>, 8> open_files;
std::atomic<int> emergencies{0};

void enter(AppendFile* file) {
  for (auto& place : open_files) {
    AppendFile* nobody = nullptr;
    if (place.compare_exchange_strong(nobody, file)) return;
  }
}

void nap() {
  const timespec time{.tv_sec = 0, .tv_nsec = 1'000'000};
  nanosleep(&time, nullptr);
}

// The file must not go away while a crash handler of another thread works with it.
void leave(AppendFile* file) {
  for (auto& place : open_files) {
    AppendFile* mine = file;
    place.compare_exchange_strong(mine, nullptr);
  }
  while (emergencies.load() != 0) nap();
}

}  // namespace

AppendFile::AppendFile(const std::string& path, std::size_t queue, FileForm form, FileParts parts)
    : ring_(queue),
      path_(path),
      form_(std::move(form)),
      parts_(parts),
      file_(std::make_unique<GrowingFile>(parts.are_wanted ? part_name(path, 1) : path, form_,
                                          patience_)),
      text_(GrowingFile::kText) {
  if (parts.are_wanted) lock_.emplace(path + ".lock");
  if (lock_ && lock_->is_elsewhere()) {
    file_->remove();
    fail(fmt::format("cannot open '{}': another run records to its parts", path));
  }
  take_failure();
  if (failed()) return;
  look_for_others();
  if (failed()) return;
  thread_ = own_thread([this] {
    try {
      write_until_stopped();
    } catch (const std::bad_alloc&) {  // what waits for the file must not wait for ever
      fail("out of memory");
      done_.ring();
      throw;
    }
  });
  enter(this);
}

AppendFile::~AppendFile() {
  end();
  leave(this);
}

const std::string& AppendFile::error() const {
  static const std::string kNone;
  return failed() ? error_ : kNone;
}

bool AppendFile::push(const Packet& packet) {
  if (failed() || !ring_.push(packet)) return false;
  const std::uint64_t pushed = ring_.pushed();
  if (pushed - called_for_ >= std::min(kFull, ring_.size() / 2)) {
    called_for_ = pushed;
    work_.ring();
  }
  return true;
}

void AppendFile::write(const Packet& packet) {
  flush();
  if (failed()) return;
  ring_.grow(packet_size(packet));
  ring_.push(packet);
  flush();
}

void AppendFile::flush() {
  while (true) {
    const std::uint32_t seen = done_.rung();
    if (failed() || ring_.empty()) return;
    work_.ring();
    done_.wait(seen, kLongestDelay);
  }
}

void AppendFile::end() {
  if (!thread_.joinable()) return;
  stopping_.store(true, std::memory_order_release);
  work_.ring();
  thread_.join();
}

void AppendFile::write_until_stopped() {
  while (true) {
    const std::uint32_t seen = work_.rung();
    const bool stops = stopping_.load(std::memory_order_acquire);
    const bool last = stops || (in_crash_.load() && form_.encoder);
    if (!has_ended_ && claim()) {
      write_out(Failure::Told);
      last ? file_->end() : file_->pass_time();
      take_failure();
      has_ended_ = last;
      if (last && !stops) fail("the process crashed");
      release();
    }
    done_.ring();
    if (stops) return;
    work_.wait(seen, kLongestDelay);
  }
}

// Nothing is written after an error: a gap in the middle would be worse than a short file. A packet
// stays in the ring until its text is in the file, and the text follows from the ring alone. So a
// crash in the middle of this costs nothing: the handler begins it again, and leaves out what is
// written.
void AppendFile::write_out(Failure failure) {
  PacketPrinter printer(ring_);
  std::uint64_t known = written_;
  while (!failed() && !ring_.empty()) {
    std::string_view text = printer.print(text_);
    if (const PacketHead* next = printer.part()) {
      if (text.empty()) {
        if (failure == Failure::Told) begin_part(*next);
        printer.pass_part();
        continue;
      }
    }
    const std::uint64_t again = std::min<std::uint64_t>(known, text.size());
    known -= again;
    file_->add(text.substr(again), failure, written_);
    if (file_->failed()) return take_failure();
    if (failure == Failure::Told) remove_others();
    part_size_.store(file_->size(), std::memory_order_relaxed);
    written_ = printer.unfinished_text();
    ring_.take_until(printer.finished());
  }
}

// The part before it is completed. It has no packet yet: its header is not in the ring.
void AppendFile::begin_part(const PacketHead& head) {
  const std::uint64_t number = part() + 1;
  const std::uint64_t first_tick = head.lost > 0 ? head.lost_from : head.tick;
  const std::string path = part_name(path_, number);
  std::error_code none;
  if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
    return fail(
        fmt::format("cannot write '{}': it is not a file", path));  // whose reader may not be
  auto next = std::make_unique<GrowingFile>(path, form_, patience_);
  if (next->failed()) return fail(next->error());
  is_between_parts_ = true;
  add_text(json_lines::part_end(first_tick));
  file_->end();
  take_failure();
  if (failed()) return;
  file_ = std::move(next);
  add_text(json_lines::part_header(header_, first_tick));
  take_failure();
  is_between_parts_ = false;
  part_size_.store(file_->size(), std::memory_order_relaxed);
  part_.store(number, std::memory_order_release);
  delete_oldest();
}

// Keeps the last files of the run, the one that is being written among them.
void AppendFile::delete_oldest() {
  if (parts_.keep == 0) return;
  const std::uint64_t before = parts_.before.size();
  for (; deleted_ + parts_.keep < before + part(); ++deleted_) {
    const bool is_before = deleted_ < before;
    ::unlink(is_before ? parts_.before[deleted_].c_str()
                       : part_name(path_, deleted_ - before + 1).c_str());
  }
}

// Writes a text that is not in the ring.
void AppendFile::add_text(std::string_view text) {
  std::uint64_t written = 0;
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), GrowingFile::kText))) {
    file_->add(text.substr(0, GrowingFile::kText), Failure::Told, written);
  }
}

// An earlier recording of this name, whose first part is replaced. A run that still writes it is
// another one, with another form of the name, or one that was resumed.
void AppendFile::look_for_others() {
  const auto add = [this](const std::string& it) {
    if (it != (parts_.are_wanted ? part_name(path_, 1) : path_)) others_.push_back(it);
  };
  const auto add_parts = [&](const std::string& recording) {
    add(recording);
    std::ranges::for_each(parts_that_exist(recording), add);
  };
  std::ranges::for_each(resumed_recordings(path_), add_parts);
  if (parts_.are_wanted) add_parts(path_);
  const auto used = std::ranges::find_if(others_, is_written_elsewhere);
  if (used == others_.end()) return;
  file_->remove();
  fail(fmt::format("cannot open '{}': another run records to '{}'", path_, *used));
}

void AppendFile::remove_others() {
  if (std::exchange(has_removed_others_, true)) return;
  for (const std::string& it : others_) ::unlink(it.c_str());
  delete_oldest();
}

void AppendFile::take_failure() {
  if (file_->failed()) fail(file_->error());
}

// With the first reason.
void AppendFile::fail(const std::string& error) {
  if (failed()) return;
  error_ = error;
  failed_.store(true, std::memory_order_release);
}

void AppendFile::set_patience(Nanoseconds patience) {
  patience_.since = monotonic_now();
  patience_.most = patience;
}

void AppendFile::emergency_flush() {
  const int before = errno;
  ++emergencies;
  const auto deadline = monotonic_now() + kLongestEmergency;
  for (auto& place : open_files) {
    if (AppendFile* file = place.load()) file->save(deadline);
  }
  --emergencies;
  errno = before;
}

void AppendFile::save(std::chrono::nanoseconds deadline) {
  if (ring_.pushed() == 0) return file_->remove();
  // Later packets, of a tick thread that still runs, are not waited for: it might never end.
  const std::uint64_t until = ring_.pushed();
  const auto is_done = [&] {
    return failed() || (form_.encoder ? has_ended_.load() : ring_.taken() >= until);
  };
  // If the crash is in the writing thread, there is nothing to wait for.
  const bool mine = claim_.load() == gettid();
  in_crash_ = true;
  work_.ring();
  while (!mine && !is_done() && monotonic_now() < deadline) nap();
  if (is_done() || form_.encoder || !(mine || claim())) return;
  if (!is_between_parts_) {
    file_->begin_crash();
    write_out(Failure::Silent);
    file_->end_in_crash();
  }
  release();
}

bool AppendFile::claim() {
  pid_t nobody = 0;
  return claim_.compare_exchange_strong(nobody, gettid(), std::memory_order_acquire);
}

void AppendFile::release() {
  claim_.store(0, std::memory_order_release);
}

}  // namespace lockstep::host
