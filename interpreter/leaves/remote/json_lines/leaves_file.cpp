#include "leaves/remote/json_lines/leaves_file.h"

#include <chrono>
#include <filesystem>
#include <fstream>

#include "leaves/remote/json_lines/line_input.h"

namespace lockstep::host {

std::string leaves_file_of(const std::string& program) {
  return std::filesystem::path(program).replace_extension(".leaves.json").string();
}

namespace {

constexpr std::uintmax_t kLargest = 16 * LineInput::kLongest;

// Not open: it is none that a program could have made.
std::ifstream open_leaves_file(const std::string& program) {
  const std::string path = leaves_file_of(program);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);  // an error of what is no regular file
  return error || size > kLargest ? std::ifstream() : std::ifstream(path);
}

}  // namespace

std::optional<std::string> read_leaves_file(const std::string& program) {
  std::ifstream file = open_leaves_file(program);
  std::string line;
  if (!std::getline(file, line) || line.size() > LineInput::kLongest) return std::nullopt;
  return line;
}

std::optional<std::string> read_description(const std::string& program, std::string_view request) {
  std::ifstream file = open_leaves_file(program);
  std::string line, answer;
  std::getline(file, line);
  while (std::getline(file, line) && std::getline(file, answer)) {
    if (line == request) return answer;
  }
  return std::nullopt;
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
