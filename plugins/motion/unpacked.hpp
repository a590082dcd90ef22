// The text of a file, which may be compressed with zstd: its first bytes tell. A file that is cut
// is read up to where it is.
#pragma once

#include <zstd.h>

#include <fstream>
#include <memory>
#include <streambuf>
#include <string>
#include <vector>

namespace motion {

class Unpacked final : public std::streambuf {
 public:
  explicit Unpacked(const std::string& name);

  bool is_open() const { return file_.is_open(); }

 private:
  // Throws a std::runtime_error where the bytes are damaged.
  int_type underflow() override;
  std::size_t read();

  std::ifstream file_;
  std::shared_ptr<ZSTD_DCtx> context_;  // null: the file is plain
  std::vector<char> bytes_, text_;
  ZSTD_inBuffer left_{nullptr, 0, 0};  // of the bytes
};

}  // namespace motion
