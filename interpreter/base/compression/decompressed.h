// The text of a file, whether it is plain or compressed with zstd: its first bytes tell. A file
// that is cut is read up to its last whole block. Used by all who open a recording.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <vector>

namespace lockstep::host {

// Thrown by a read: the bytes cannot be decompressed, or would give far too much text.
class CannotDecompress : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Decompressed final : public std::streambuf {
 public:
  // `file` must outlive it. Nothing is read yet.
  explicit Decompressed(std::streambuf& file);
  ~Decompressed() override;

 private:
  struct Frame {
    std::uint64_t text = 0, file = 0;  // where it begins
  };

  int_type underflow() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode) override;

  void look();
  void check_frame() const;
  bool fill_plain();
  bool fill_compressed();
  bool read_file();
  bool go_to_frame(std::uint64_t text);
  std::optional<std::uint64_t> text_size();
  bool read_table();
  std::uint64_t text_position() const {
    return text_end_ - static_cast<std::uint64_t>(egptr() - gptr());
  }

  struct Decompressor;
  std::streambuf& file_;
  std::unique_ptr<Decompressor> zstd_;  // null: the file is plain, or nothing has been read
  bool has_looked_ = false;
  std::vector<char> bytes_, text_;
  std::size_t at_ = 0, count_ = 0;  // of the bytes of the file: those that are used, and all
  std::uint64_t file_end_ = 0, text_end_ = 0;  // behind what has been read
  std::uint64_t frame_begin_ = 0;              // in the file, of the frame that is read
  std::vector<Frame> frames_;                  // that are known, in order
  std::optional<std::uint64_t> size_;          // of the text, once it is known
  bool has_table_ = false;                     // which says so, and has all frames
};

// The text of a file with a name. Not open: errno says why.
class DecompressedFile {
 public:
  explicit DecompressedFile(const std::string& path)
      : file_(path, std::ios::binary), buffer_(*file_.rdbuf()), text_(&buffer_) {}
  bool is_open() const { return file_.is_open(); }
  std::istream& text() { return text_; }

 private:
  std::ifstream file_;
  Decompressed buffer_;
  std::istream text_;
};

}  // namespace lockstep::host
