// The text of a recording that is in several files, as one text: one behind the other. Also those
// that are written while it is read.
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <streambuf>
#include <string>
#include <vector>

#include "base/compression/decompressed.h"

namespace lockstep::host {

class RecordingParts final : public std::streambuf {
 public:
  // Its parts are beside where the recording would be: record/part_names.h.
  explicit RecordingParts(std::string recording);

 private:
  int_type underflow() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode) override;

  void open(std::size_t part);
  bool knows_next();
  std::size_t read();
  std::uint64_t size_of(std::size_t part);
  template <class Use>
  auto in_part(Use use);

  const std::string recording_;
  std::vector<std::string> paths_;
  std::vector<std::uint64_t> sizes_;  // of the texts of the first parts, as far as they are known
  std::size_t at_ = 0;                // the part that is open
  std::unique_ptr<DecompressedFile> file_;
  std::uint64_t begin_ = 0;  // of its text, in all
  std::vector<char> text_;
  std::uint64_t end_ = 0;  // behind what has been read, in all
};

// A recording by its name: a file, or its parts where there is no such file. Not open: errno says
// why.
class NamedRecording {
 public:
  explicit NamedRecording(const std::string& path);
  bool is_open() const { return parts_ != nullptr || file_->is_open(); }
  std::istream& text() { return parts_ != nullptr ? all_ : file_->text(); }

 private:
  std::unique_ptr<RecordingParts> parts_;
  std::istream all_{nullptr};
  std::unique_ptr<DecompressedFile> file_;
};

}  // namespace lockstep::host
