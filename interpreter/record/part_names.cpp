#include "record/part_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::string_view kPacked = ".zst";

// Where the number comes in: before ".jsonl.zst", ".mcap".
std::size_t place_of_number(std::string_view path) {
  std::string_view name = path;
  if (name.ends_with(kPacked)) name.remove_suffix(kPacked.size());
  const std::size_t begin = path.rfind('/') + 1;  // 0 when there is none
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos || dot <= begin ? name.size() : dot;
}

std::optional<std::uint64_t> number_in(std::string_view name, std::string_view before,
                                       std::string_view behind) {
  constexpr std::size_t kLeast = 4;
  if (name.size() < before.size() + behind.size() + kLeast) return std::nullopt;
  if (!name.starts_with(before) || !name.ends_with(behind)) return std::nullopt;
  name.remove_prefix(before.size());
  name.remove_suffix(behind.size());
  std::uint64_t number = 0;
  const auto end = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = end.ec == std::errc() && end.ptr == name.data() + name.size();
  return is_number ? std::optional(number) : std::nullopt;
}

std::string resumed_name(const std::string& recording, std::size_t number) {
  const std::size_t place = place_of_number(recording);
  return fmt::format("{}.resumed-{}{}", recording.substr(0, place), number,
                     recording.substr(place));
}

// As one file, or in parts.
bool is_there(const std::string& recording) {
  std::error_code none;
  return std::filesystem::is_regular_file(recording, none) || !parts_that_exist(recording).empty();
}

}  // namespace

std::string part_name(const std::string& recording, std::uint64_t number) {
  const std::size_t place = place_of_number(recording);
  return fmt::format("{}.{:04}{}", recording.substr(0, place), number, recording.substr(place));
}

std::vector<std::string> parts_that_exist(const std::string& recording) {
  const std::size_t place = place_of_number(recording);
  const std::size_t begin = recording.rfind('/') + 1;
  const std::string before = recording.substr(begin, place - begin) + ".";
  const std::string behind = recording.substr(place);
  const std::string folder = recording.substr(0, begin);
  std::vector<std::pair<std::uint64_t, std::string>> found;
  std::error_code none;  // a folder that cannot be read has none
  for (std::filesystem::directory_iterator it(folder.empty() ? "." : folder, none), end;
       !none && it != end; it.increment(none)) {
    const std::string name = it->path().filename().string();
    const auto number = number_in(name, before, behind);
    if (number && !it->is_directory(none)) {
      found.emplace_back(*number, folder + name);
    }
  }
  std::ranges::sort(found);
  std::vector<std::string> parts;
  for (auto& [number, path] : found) parts.push_back(std::move(path));
  return parts;
}

std::vector<std::string> resumed_recordings(const std::string& recording) {
  std::vector<std::string> names;
  for (std::string name = resumed_name(recording, 1); is_there(name);
       name = resumed_name(recording, names.size() + 1)) {
    names.push_back(std::move(name));
  }
  return names;
}

std::string name_of_resumed(const std::string& recording) {
  if (!is_there(recording)) return recording;
  return resumed_name(recording, resumed_recordings(recording).size() + 1);
}

}  // namespace lockstep::host
