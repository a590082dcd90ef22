// A file of a recording on the disk, which only grows: the text as it is, compressed, or what an
// encoder makes of it. It gets its name, and replaces an existing file, with the first whole line:
// base/system/output_file.h. The first error ends the writing. Used by append_file.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/compression/zstd_frames.h"
#include "base/core/clock.h"
#include "base/system/output_file.h"
#include "record/text_encoder.h"

namespace lockstep::host {

enum class Compression { None, Zstd };

struct FileForm {
  Compression compression = Compression::None;
  MakeEncoder encoder = {};  // in place of it
};

// How long a pipe or a device is waited for that takes nothing.
struct Patience {
  std::atomic<Nanoseconds> most{Nanoseconds::max()}, since{Nanoseconds(0)};
  bool is_over = false;
};

// Whoever writes a file has a lock on it, which ends with the process.
bool is_written_elsewhere(const std::string& path);

class GrowingFile {
 public:
  static constexpr std::size_t kText = 64u << 10;  // bytes: the most that are added at once
  // In a crash handler, an error is silent, and nothing is waited for.
  enum class Failure { Told, Silent };

  // On failure error() has the reason.
  GrowingFile(std::string path, const FileForm& form, Patience& patience);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  bool failed() const { return failed_; }
  // "" if there is no error, else "cannot write 'x': No space left on device".
  const std::string& error() const { return error_; }
  // How much it has on the disk. May be called from any thread.
  std::uint64_t size() const { return size_.load(std::memory_order_relaxed); }

  // Adds to `written` how many bytes of the text are in the file, also if that has failed.
  void add(std::string_view text, Failure failure, std::uint64_t& written);
  // No text has come for a while.
  void pass_time();
  // Completes it. Nothing more may be added.
  void end();

  // For a crash handler; async-signal-safe, as is add() with Failure::Silent. Not with an encoder.
  void end_in_crash();
  void begin_crash() const;  // nothing is waited for
  void remove() const { out_.remove(); }

 private:
  void add_plain(std::string_view text, Failure failure, std::uint64_t& written);
  void add_compressed(std::string_view text, Failure failure);
  template <class Encode>
  void encode(Encode encode);
  void end_frame(Failure failure);
  void write_whole(std::string_view bytes, Failure failure);
  std::size_t write_some(std::string_view bytes, Failure failure);
  void take_name(Failure failure);
  bool await_room();
  void give_up(const char* what, Failure failure);
  void cut_back();
  void fail(const char* what, const std::string& reason);

  const std::string path_;
  OutputFile out_;
  const int file_;
  Patience& patience_;
  std::optional<ZstdFrames> frames_;
  std::unique_ptr<TextEncoder> encoder_;
  std::atomic<std::uint64_t> size_{0};
  // Bytes at its end that are not a whole line; of a compressed file, a whole block.
  std::uint64_t unfinished_ = 0;
  bool has_line_ = false;  // a whole one is in the file
  bool failed_ = false;
  std::string error_;
};

}  // namespace lockstep::host
