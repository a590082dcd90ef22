#include "remote/json_lines/leaves_file.h"

#include <chrono>
#include <filesystem>
#include <fstream>

#include "remote/json_lines/line_input.h"

namespace lockstep::host {

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

bool is_older_than_program(const std::string& program) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(leaves_file_of(program), error);
  if (error) return false;
  const auto changed = std::filesystem::last_write_time(program, error);
  // A checkout or an installation writes both at about the same time.
  return !error && written + std::chrono::seconds(2) < changed;
}

}  // namespace lockstep::host
