#include "record/read/recording_parts.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "record/json_lines.h"
#include "record/part_names.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kRead = 64u << 10;  // bytes

// The files of a recording without those that continue it after a cut.
std::vector<std::string> own_files(const std::string& recording) {
  std::error_code none;
  if (std::filesystem::exists(recording, none)) return {recording};
  return parts_to_read(recording);
}

struct Begin {
  std::uint64_t tick = 0;
  bool is_resumed = false;  // the first file of a process that continues
};

Begin begin_of(const std::string& path) {
  DecompressedFile file(path);
  if (!file.is_open()) return {};
  const RecordingReader reader(file.text(), path);
  if (!reader.error().empty()) return {};
  return {reader.header().first_tick, reader.header().resumed_after.has_value()};
}

std::uint64_t first_tick_of(const std::string& path) {
  return begin_of(path).tick;
}

struct BeforeCut {
  std::uint64_t size = 0;  // bytes
  std::uint64_t next = 0;  // tick
};

// Those of the lines before a tick, up to the last line of a tick or of a gap: a crash may have
// written a closing line behind it. Nothing if a line is damaged: who reads the file reports that.
std::optional<BeforeCut> lines_before(const std::string& path, std::uint64_t tick) {
  BeforeCut before{.next = first_tick_of(path)};
  DecompressedFile file(path);
  LineReader lines(file.text(), RecordingReader::Limits().line);
  while (lines.next() && lines.has_end()) {
    const auto next = json_lines::next_tick_of(lines.text());
    if (next && *next > tick) break;
    if (next) before.next = *next;
    if (next || before.size == 0) before.size = lines.position().bytes;
  }
  const bool is_read = lines.damage().empty() && !lines.is_too_long();
  return is_read ? std::optional(before) : std::nullopt;
}

}  // namespace

RecordingParts::RecordingParts(const std::string& recording)
    : recording_(recording), process_(recording), text_(kRead) {
  for (const std::string& path : own_files(recording)) parts_.push_back({path});
  for (const std::string& resumed : resumed_recordings(recording)) continue_with(resumed);
}

void RecordingParts::continue_with(const std::string& resumed) {
  const std::vector<std::string> files = own_files(resumed);
  if (files.empty()) return parts_.push_back({resumed});  // it is missing: reading ends there
  const auto [tick, is_first] = begin_of(files.front());
  if (tick == 0) return;  // it continues nothing: another recording of that name
  if (is_first) {
    if (!parts_.empty()) end_before(tick);
  } else if (!is_open_) {  // files before it were deleted, so those of the process before were too
    parts_.clear();
  }
  for (const std::string& path : files) parts_.push_back({path});
  process_ = resumed;
}

// What came after the state that the run continued from was lost with it, so the run did it again.
// What has been read until then stays: the text then has it twice.
void RecordingParts::end_before(std::uint64_t tick) {
  const std::size_t read_parts = is_open_ ? at_ + 1 : 1;
  while (parts_.size() > read_parts &&
         (parts_.back().path.empty() || first_tick_of(parts_.back().path) >= tick))
    parts_.pop_back();
  Part& last = parts_.back();
  const auto before = lines_before(last.path, tick);
  if (!before) return;
  const std::uint64_t is_read = is_open_ && parts_.size() == at_ + 1 ? end_ - begin_ : 0;
  const bool ends_in_line = is_read > before->size && !ends_line_;
  last.size = std::max(before->size, is_read);
  last.is_cut = true;
  std::string lines = ends_in_line ? "\n" : "";
  if (before->next < tick) lines += json_lines::lost(tick - before->next, before->next);
  lines += json_lines::part_end(tick);
  parts_.push_back({.path = "", .lines = lines, .size = lines.size()});
}

std::optional<RecordingParts::Place> RecordingParts::place_of(std::uint64_t byte) {
  std::size_t part = 0;
  std::uint64_t begin = 0;
  try {
    while (part + 1 < parts_.size() && begin + size_of(part) <= byte) begin += size_of(part++);
    // Lines without a file say where the one before them ends.
    if (parts_[part].path.empty()) byte = begin == 0 ? 0 : begin - 1, begin -= size_of(--part);
    DecompressedFile file(parts_[part].path);
    std::uint64_t line = 1;
    for (std::uint64_t left = byte - begin; left > 0;) {
      const std::uint64_t most = std::min<std::uint64_t>(left, kRead);
      std::string text(most, '\0');
      const auto count =
          file.text().rdbuf()->sgetn(text.data(), static_cast<std::streamsize>(most));
      if (count <= 0) break;
      line += static_cast<std::uint64_t>(std::count(text.begin(), text.begin() + count, '\n'));
      left -= static_cast<std::uint64_t>(count);
    }
    return Place{parts_[part].path, line};
  } catch (const CannotDecompress&) {
    return Place{parts_[part].path};
  }
}

RecordingParts::int_type RecordingParts::underflow() {
  if (!is_open_) {
    if (parts_.empty()) return traits_type::eof();
    open(0);
  }
  std::size_t count = read();
  while (count == 0 && knows_next()) {
    // It may have grown until the next one came.
    if ((count = read()) > 0) break;
    open(at_ + 1);
    count = read();
  }
  if (count == 0) return traits_type::eof();
  setg(text_.data(), text_.data(), text_.data() + count);
  end_ += count;
  ends_line_ = text_[count - 1] == '\n';
  return traits_type::to_int_type(text_.front());
}

std::size_t RecordingParts::read() {
  const Part& part = parts_[at_];
  std::uint64_t most = text_.size();
  if (part.is_cut || !file_) most = std::min(most, *part.size - (end_ - begin_));
  if (!file_) return part.lines.copy(text_.data(), most, end_ - begin_);
  const auto count = static_cast<std::streamsize>(most);
  return static_cast<std::size_t>(file_->text().rdbuf()->sgetn(text_.data(), count));
}

bool RecordingParts::knows_next() {
  if (at_ + 1 < parts_.size()) return true;
  std::error_code none;
  if (!std::filesystem::exists(process_, none)) {
    for (std::string& it : parts_to_read(process_, parts_.back().path))
      parts_.push_back({std::move(it)});
  }
  if (at_ + 1 == parts_.size()) look_for_next_process();
  return at_ + 1 < parts_.size();
}

// The run may have been cut while it is read, and continues in another file.
void RecordingParts::look_for_next_process() {
  for (const std::string& next : resumed_recordings(recording_, process_)) {
    if (at_ + 1 < parts_.size()) return;
    if (!own_files(next).empty()) continue_with(next);
  }
}

void RecordingParts::open(std::size_t part) {
  begin_ = 0;
  for (std::size_t i = 0; i < part; ++i) begin_ += size_of(i);
  file_.reset();
  if (const std::string& path = parts_[part].path; !path.empty()) {
    errno = 0;
    file_ = std::make_unique<DecompressedFile>(path);
    if (!file_->is_open()) {
      throw CannotDecompress(fmt::format("cannot read its part '{}': {}", path,
                                         std::generic_category().message(errno)));
    }
  }
  is_open_ = true;
  at_ = part;
  end_ = begin_;
  setg(nullptr, nullptr, nullptr);
}

std::uint64_t RecordingParts::size_of(std::size_t part) {
  Part& it = parts_[part];
  if (!it.size) {
    DecompressedFile file(it.path);
    const auto end = static_cast<std::streamoff>(
        file.text().rdbuf()->pubseekoff(0, std::ios_base::end, std::ios_base::in));
    it.size = static_cast<std::uint64_t>(std::max<std::streamoff>(end, 0));
  }
  return *it.size;
}

RecordingParts::pos_type RecordingParts::seekoff(off_type offset, std::ios_base::seekdir way,
                                                 std::ios_base::openmode which) {
  if (way == std::ios_base::cur && offset == 0) {
    return static_cast<off_type>(end_ - static_cast<std::uint64_t>(egptr() - gptr()));
  }
  if (way == std::ios_base::end && offset == 0) {
    off_type size = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) size += static_cast<off_type>(size_of(i));
    return seekpos(size, which);
  }
  if (way != std::ios_base::beg || offset < 0) return pos_type(off_type(-1));
  return seekpos(offset, which);
}

RecordingParts::pos_type RecordingParts::seekpos(pos_type position, std::ios_base::openmode which) {
  const auto place = static_cast<std::uint64_t>(off_type(position));
  std::size_t part = 0;
  std::uint64_t begin = 0;
  while (part + 1 < parts_.size() && begin + size_of(part) <= place) begin += size_of(part++);
  if (!is_open_ || part != at_) open(part);
  if (!file_) {
    setg(nullptr, nullptr, nullptr);
    end_ = place;
    return position;
  }
  const auto there = static_cast<off_type>(place - begin);
  const pos_type found = file_->text().rdbuf()->pubseekpos(there, which);
  if (off_type(found) < 0) return found;
  setg(nullptr, nullptr, nullptr);
  end_ = place;
  return position;
}

NamedRecording::NamedRecording(const std::string& path, Reading reading) {
  std::error_code none;
  const bool is_whole = std::filesystem::exists(path, none);
  const bool may_continue = reading == Reading::Follows &&
                            std::filesystem::is_regular_file(path, none) &&
                            access(path.c_str(), R_OK) == 0;
  if (may_continue || !resumed_recordings(path).empty() ||
      (!is_whole && !parts_to_read(path).empty())) {
    parts_ = std::make_unique<RecordingParts>(path);
    all_.rdbuf(parts_.get());
  } else {
    errno = 0;
    file_ = std::make_unique<DecompressedFile>(path);
  }
}

}  // namespace lockstep::host
