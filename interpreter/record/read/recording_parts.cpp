#include "record/read/recording_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "record/part_names.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kRead = 64u << 10;  // bytes

}  // namespace

RecordingParts::RecordingParts(std::string recording)
    : recording_(std::move(recording)), paths_(parts_that_exist(recording_)), text_(kRead) {}

// An error names the part that has it.
template <class Use>
auto RecordingParts::in_part(Use use) {
  try {
    return use();
  } catch (const CannotDecompress& damage) {
    throw CannotDecompress(fmt::format("in '{}', {}", paths_[at_], damage.what()));
  }
}

RecordingParts::int_type RecordingParts::underflow() {
  if (!file_) {
    if (paths_.empty()) return traits_type::eof();
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
  return traits_type::to_int_type(text_.front());
}

std::size_t RecordingParts::read() {
  return in_part([this] {
    const auto count = static_cast<std::streamsize>(text_.size());
    return static_cast<std::size_t>(file_->text().rdbuf()->sgetn(text_.data(), count));
  });
}

bool RecordingParts::knows_next() {
  if (at_ + 1 < paths_.size()) return true;
  // The first parts of a run that goes on may be deleted.
  for (std::string& it : parts_that_exist(recording_)) {
    const bool is_later = it.size() > paths_.back().size() ||
                          (it.size() == paths_.back().size() && it > paths_.back());
    if (is_later) paths_.push_back(std::move(it));
  }
  return at_ + 1 < paths_.size();
}

void RecordingParts::open(std::size_t part) {
  begin_ = 0;
  for (std::size_t i = 0; i < part; ++i) begin_ += size_of(i);
  errno = 0;
  file_ = std::make_unique<DecompressedFile>(paths_[part]);
  if (!file_->is_open()) {
    throw CannotDecompress(fmt::format("cannot read its part '{}': {}", paths_[part],
                                       std::generic_category().message(errno)));
  }
  at_ = part;
  end_ = begin_;
  setg(nullptr, nullptr, nullptr);
}

std::uint64_t RecordingParts::size_of(std::size_t part) {
  while (sizes_.size() <= part) {
    DecompressedFile file(paths_[sizes_.size()]);
    const auto end = static_cast<std::streamoff>(
        file.text().rdbuf()->pubseekoff(0, std::ios_base::end, std::ios_base::in));
    sizes_.push_back(static_cast<std::uint64_t>(std::max<std::streamoff>(end, 0)));
  }
  return sizes_[part];
}

RecordingParts::pos_type RecordingParts::seekoff(off_type offset, std::ios_base::seekdir way,
                                                 std::ios_base::openmode which) {
  if (way == std::ios_base::cur && offset == 0) {
    return static_cast<off_type>(end_ - static_cast<std::uint64_t>(egptr() - gptr()));
  }
  if (way == std::ios_base::end && offset == 0) {
    off_type size = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) size += static_cast<off_type>(size_of(i));
    return seekpos(size, which);
  }
  if (way != std::ios_base::beg || offset < 0) return pos_type(off_type(-1));
  return seekpos(offset, which);
}

RecordingParts::pos_type RecordingParts::seekpos(pos_type position, std::ios_base::openmode which) {
  const auto place = static_cast<std::uint64_t>(off_type(position));
  std::size_t part = 0;
  std::uint64_t begin = 0;
  while (part + 1 < paths_.size() && begin + size_of(part) <= place) begin += size_of(part++);
  if (!file_ || part != at_) open(part);
  const auto there = static_cast<off_type>(place - begin);
  const pos_type found = in_part([&] { return file_->text().rdbuf()->pubseekpos(there, which); });
  if (off_type(found) < 0) return found;
  setg(nullptr, nullptr, nullptr);
  end_ = place;
  return position;
}

NamedRecording::NamedRecording(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none) && !parts_that_exist(path).empty()) {
    parts_ = std::make_unique<RecordingParts>(path);
    all_.rdbuf(parts_.get());
  } else {
    errno = 0;
    file_ = std::make_unique<DecompressedFile>(path);
  }
}

}  // namespace lockstep::host
