#include "document/file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace lockstep {
namespace {

FileText failed(int error) {
  return {{}, std::generic_category().message(error)};
}

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

FileText read_file(const std::string& path, std::size_t limit) {
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) return failed(errno);
  FileText result;
  constexpr std::size_t kChunk = 1u << 16u;
  while (result.text.size() <= limit) {
    const auto before = result.text.size();
    result.text.resize(before + kChunk);
    const auto count = std::fread(result.text.data() + before, 1, kChunk, file.get());
    result.text.resize(before + count);
    if (std::ferror(file.get())) return failed(errno);
    if (count == 0) break;
  }
  return result;
}

}  // namespace lockstep
