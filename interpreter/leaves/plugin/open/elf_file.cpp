#include "leaves/plugin/open/elf_file.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

namespace lockstep::host {
namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);

// The header of this very program, as far as it says for which machine it is.
Header own_header() {
  Header own{};
  std::ifstream self("/proc/self/exe", std::ios::binary);
  self.read(reinterpret_cast<char*>(&own), sizeof own);
  return own;
}

bool same_machine(const Header& a, const Header& b) {
  return a.e_machine == b.e_machine && a.e_ident[EI_CLASS] == b.e_ident[EI_CLASS] &&
         a.e_ident[EI_DATA] == b.e_ident[EI_DATA];
}

// Mapping a segment beyond the end of its file succeeds, and touching it kills the process.
bool is_cut_off(std::ifstream& file, const Header& header, std::uintmax_t size) {
  if (header.e_phentsize != sizeof(Segment)) return true;
  std::vector<Segment> segments(header.e_phnum);
  file.seekg(static_cast<std::streamoff>(header.e_phoff));
  file.read(reinterpret_cast<char*>(segments.data()),
            static_cast<std::streamsize>(segments.size() * sizeof(Segment)));
  if (!file) return true;
  for (const Segment& segment : segments) {
    if (segment.p_type != PT_LOAD) continue;
    if (segment.p_offset > size || segment.p_filesz > size - segment.p_offset) return true;
  }
  return false;
}

Problem not_a_shared_object(const char* what) {
  return {fmt::format("is not a shared object: {}", what),
          "build it as a MODULE or SHARED library (`lockstep docs plugins`)"};
}

std::optional<Problem> inspect_header(std::ifstream& file, std::uintmax_t size) {
  Header header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  const auto length = static_cast<std::size_t>(file.gcount());
  if (length < EI_NIDENT + 4 || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    return not_a_shared_object("it does not begin like an ELF file");
  }
  if (!same_machine(header, own_header())) {
    return Problem{"is for another kind of machine than this program",
                   "'file' shows which; build it on, or cross-compile it for, the machine that "
                   "runs the tree"};
  }
  if (header.e_type == ET_REL) return not_a_shared_object("it is an object file");
  if (header.e_type != ET_DYN) return not_a_shared_object("it is a program");
  if (length < sizeof header || is_cut_off(file, header, size)) {
    return Problem{"is cut off: parts of the file are missing", "copy or build it again"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> inspect_elf_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return Problem{error && error != std::errc::no_such_file_or_directory
                       ? fmt::format("cannot be opened: {}", error.message())
                       : "does not exist",
                   "check the path; a tree names plugins without path and without '.so'"};
  }
  if (!std::filesystem::is_regular_file(status)) {
    return not_a_shared_object(std::filesystem::is_directory(status) ? "it is a directory"
                                                                     : "it is not a file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Problem{fmt::format("cannot be opened: {}", std::strerror(errno)),
                   "check its permissions"};
  }
  return inspect_header(file, std::filesystem::file_size(path, error));
}

}  // namespace lockstep::host
