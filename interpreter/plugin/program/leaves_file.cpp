#include "plugin/program/leaves_file.h"

#include <filesystem>
#include <fstream>

#include "plugin/program/line_input.h"

namespace lockstep {

std::string leaves_file_of(const std::string& program) {
  return std::filesystem::path(program).replace_extension(".leaves.json").string();
}

std::optional<std::string> read_leaves_file(const std::string& program) {
  const std::string path = leaves_file_of(program);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);  // an error of what is no regular file
  if (error || size > LineInput::kLongest) return std::nullopt;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return line;
}

}  // namespace lockstep
