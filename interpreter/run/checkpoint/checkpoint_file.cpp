#include "run/checkpoint/checkpoint_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/core/crc32c.h"
#include "base/system/file_descriptor.h"
#include "run/checkpoint/archive.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kMagic = "lockstep checkpoint\n";
constexpr std::uint32_t kVersion = 4;
constexpr std::uint64_t kBlock = 4096;
// Nothing larger is read or written.
constexpr std::uint64_t kLargest = std::uint64_t{1} << 30;

std::string reason_text(int reason) {
  return std::generic_category().message(reason);
}

struct FileHead {
  std::uint32_t version = kVersion;
  std::uint64_t facts = 0, first = 0, room = 0;  // sizes and the place of the first slot
  std::uint32_t facts_sum = 0;
};
struct SlotHead {
  std::uint64_t number = 0, size = 0;
};

void fields(auto& it, Is<FileHead> auto& head) {
  it(head.version, head.facts, head.first, head.room, head.facts_sum);
}

void fields(auto& it, Is<SlotHead> auto& head) {
  it(head.number, head.size);
}

constexpr std::size_t kFileHead = kMagic.size() + 3 * 8 + 2 * 4 + 4;  // with its checksum
constexpr std::size_t kSlotHead = 2 * 8 + 4;                          // likewise

std::uint32_t sum_at(std::string_view bytes, std::size_t place) {
  std::uint32_t sum = 0;
  std::memcpy(&sum, bytes.data() + place, sizeof sum);
  return sum;
}

void append_sum(std::string& bytes, std::uint32_t sum) {
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

std::uint64_t whole_blocks(std::uint64_t size) {
  return (size + kBlock - 1) / kBlock * kBlock;
}

constexpr const char* kOfAnother = "it belongs to another user";

// What is not to be read or replaced; "": nothing is there, or a file of this user.
std::string refusal(const std::string& path) {
  struct stat named {};
  if (lstat(path.c_str(), &named) != 0) return errno == ENOENT ? "" : reason_text(errno);
  if (S_ISLNK(named.st_mode)) return "it is a symbolic link; name the file itself";
  if (S_ISDIR(named.st_mode)) return reason_text(EISDIR);
  if (!S_ISREG(named.st_mode)) return "it is not a file";
  return named.st_uid == geteuid() ? "" : kOfAnother;
}

// All of it; nothing, with errno.
std::optional<std::string> read_all(const std::string& path) {
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat opened {};
  if (file.number() < 0 || fstat(file.number(), &opened) != 0) return std::nullopt;
  errno = EFBIG;
  if (!S_ISREG(opened.st_mode) || opened.st_size > static_cast<off_t>(kLargest)) {
    return std::nullopt;
  }
  std::string bytes(static_cast<std::size_t>(opened.st_size), '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t got = read(file.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
  return bytes;
}

bool put(int file, std::string_view bytes, std::uint64_t place) {
  while (!bytes.empty()) {
    const ssize_t size = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(size));
    place += static_cast<std::uint64_t>(size);
  }
  return true;
}

// So that the name of a file in it reaches the disk.
void sync_folder_of(const std::string& path) {
  const std::string folder = path.substr(0, path.rfind('/') + 1);
  const FileDescriptor directory(
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.number() >= 0) fsync(directory.number());
}

// The bytes of the newest whole slot.
std::optional<std::string_view> newest(std::string_view file, const FileHead& head) {
  std::optional<std::string_view> found;
  std::uint64_t most = 0;
  for (unsigned slot = 0; slot < CheckpointFile::kSlots; ++slot) {
    const std::uint64_t place = head.first + slot * head.room;
    if (place > file.size() || file.size() - place < kSlotHead) break;
    const std::string_view bytes = file.substr(place, head.room);
    SlotHead it;
    ByteReader reader(bytes);
    reader(it);
    if (it.number <= most || it.size > bytes.size() - kSlotHead) continue;
    const std::string_view state = bytes.substr(kSlotHead, it.size);
    if (sum_at(bytes, kSlotHead - 4) != crc32c(state, crc32c(bytes.substr(0, kSlotHead - 4)))) {
      continue;
    }
    most = it.number;
    found = state;
  }
  return found;
}

bool read_head(std::string_view file, FileHead& head) {
  if (file.size() < kFileHead || !file.starts_with(kMagic)) return false;
  if (sum_at(file, kFileHead - 4) != crc32c(file.substr(0, kFileHead - 4))) return false;
  ByteReader reader(file.substr(kMagic.size(), kFileHead - kMagic.size() - 4));
  reader(head);
  return head.version == kVersion && head.facts <= file.size() - kFileHead &&
         head.first <= file.size() && head.room <= file.size();
}

}  // namespace

CheckpointFile::CheckpointFile(std::string path) : path_(std::move(path)) {
  std::string why = refusal(path_);
  if (why.empty()) {
    const auto old = read_all(path_);
    if (!old && errno != ENOENT) why = reason_text(errno);
    if (old && !old->empty() && !old->starts_with(kMagic)) why = "it is not a checkpoint";
  }
  if (why.empty()) {
    lock_.emplace(path_ + ".lock");
    if (lock_->is_elsewhere()) why = "another run keeps its checkpoints there";
  }
  if (!why.empty()) error_ = fmt::format("cannot open '{}': {}", path_, why);
}

bool CheckpointFile::fail() {
  if (error_.empty()) error_ = fmt::format("cannot write '{}': {}", path_, reason_text(errno));
  return false;
}

bool CheckpointFile::begin(std::string facts, std::string_view checkpoint) {
  facts_ = std::move(facts);
  return make(checkpoint, 2 * whole_blocks(kSlotHead + checkpoint.size()));
}

bool CheckpointFile::make(std::string_view checkpoint, std::uint64_t room) {
  if (!error_.empty()) return false;
  Slots fresh{std::make_unique<OutputFile>(path_), whole_blocks(kFileHead + facts_.size()), room};
  if (!fresh.out->error().empty()) {
    error_ = fresh.out->error();
    return false;
  }
  const std::uint64_t size = fresh.first + kSlots * room;
  errno = EFBIG;
  if (size > kLargest) return fail();
  // A file that is open for appending is written at its end, wherever a write is to go.
  const int file = fresh.out->descriptor();
  const int flags = fcntl(file, F_GETFL);
  if (flags < 0 || fcntl(file, F_SETFL, flags & ~O_APPEND) != 0) return fail();
  // From then on a full disk harms nothing that fits.
  errno = posix_fallocate(file, 0, static_cast<off_t>(size));
  if (errno != 0) return fail();
  std::string head(kMagic);
  ByteWriter writer(head);
  writer(FileHead{
      .facts = facts_.size(), .first = fresh.first, .room = room, .facts_sum = crc32c(facts_)});
  append_sum(head, crc32c(head));
  if (!put(file, head + facts_, 0) || !write_slot(fresh, 0, checkpoint) || fdatasync(file) != 0 ||
      !fresh.out->take_name()) {
    return fail();
  }
  sync_folder_of(path_);
  slots_ = std::move(fresh);
  newest_ = synced_ = 0;
  return true;
}

bool CheckpointFile::write_slot(const Slots& slots, unsigned slot, std::string_view checkpoint) {
  std::string head;
  ByteWriter writer(head);
  writer(SlotHead{.number = ++number_, .size = checkpoint.size()});
  append_sum(head, crc32c(checkpoint, crc32c(head)));
  const std::uint64_t place = slots.first + slot * slots.room;
  const int file = slots.out->descriptor();
  return put(file, checkpoint, place + kSlotHead) && put(file, head, place);
}

unsigned CheckpointFile::free_slot() const {
  unsigned slot = 0;
  while (slot == newest_ || slot == synced_) ++slot;
  return slot;
}

bool CheckpointFile::write(std::string_view checkpoint) {
  if (!error_.empty()) return false;
  std::uint64_t room = slots_.room;
  while (room < kSlotHead + checkpoint.size()) room *= 2;
  if (room != slots_.room) return make(checkpoint, room);
  const unsigned slot = free_slot();
  if (!write_slot(slots_, slot, checkpoint)) return fail();
  newest_ = slot;
  return true;
}

bool CheckpointFile::sync() {
  if (!error_.empty() || synced_ == newest_) return error_.empty();
  if (fdatasync(slots_.out->descriptor()) != 0) return fail();
  synced_ = newest_;
  return true;
}

void CheckpointFile::write_last(std::string_view checkpoint) {
  if (slots_.out == nullptr || kSlotHead + checkpoint.size() > slots_.room) return;
  const unsigned slot = free_slot();
  if (!write_slot(slots_, slot, checkpoint) || fdatasync(slots_.out->descriptor()) != 0) {
    fail();
    return;
  }
  newest_ = synced_ = slot;
}

Result<std::optional<KeptCheckpoint>> read_checkpoint_file(const std::string& path,
                                                           CheckpointReader reader) {
  const std::string why = refusal(path);
  if (!why.empty() && (reader == CheckpointReader::Continues || why != kOfAnother)) {
    return problem(fmt::format("cannot open '{}': {}", path, why));
  }
  const auto bytes = read_all(path);
  if (!bytes && errno == ENOENT) return std::nullopt;
  if (!bytes) return problem(fmt::format("cannot read '{}': {}", path, reason_text(errno)));
  if (!bytes->starts_with(kMagic)) {
    return problem(fmt::format("'{}' is not a checkpoint of lockstep", path));
  }
  FileHead head;
  KeptCheckpoint kept;
  const bool is_known = read_head(*bytes, head);
  const std::string_view facts =
      is_known ? std::string_view(*bytes).substr(kFileHead, head.facts) : std::string_view();
  if (!is_known || crc32c(facts) != head.facts_sum || !read_facts(facts, kept.facts)) {
    return problem(fmt::format("'{}' is damaged, or of another version of lockstep", path));
  }
  const auto state = newest(*bytes, head);
  if (!state || !read_checkpoint_bytes(*state, kept.checkpoint)) {
    return problem(fmt::format("'{}' is damaged: no checkpoint in it is whole", path));
  }
  return kept;
}

}  // namespace lockstep::host
