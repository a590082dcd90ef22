#include "record/part_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/compression/decompressed.h"
#include "base/json/reader.h"
#include "record/header_line.h"
#include "record/lines.h"

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

// The names of the files of a recording: run.jsonl, run.0001.jsonl, run.resumed-2.0001.jsonl.
struct Names {
  explicit Names(const std::string& recording) {
    const std::size_t begin = recording.rfind('/') + 1, place = place_of_number(recording);
    folder = recording.substr(0, begin);
    stem = recording.substr(begin, place - begin);
    ending = recording.substr(place);
  }

  std::string whole(std::uint64_t resumed) const {
    return resumed == 0 ? folder + stem + ending
                        : fmt::format("{}{}.resumed-{}{}", folder, stem, resumed, ending);
  }

  std::string folder, stem, ending;
};

// Takes digits from the front; nothing where there are none or too many.
std::optional<std::uint64_t> take_number(std::string_view& text) {
  std::uint64_t number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end.ptr - text.data()));
  return number;
}

// The number of a part in ".0001"; 0: "", the whole file.
std::optional<std::uint64_t> part_in(std::string_view text) {
  constexpr std::size_t kLeast = 5;
  if (text.empty()) return 0;
  if (text.size() < kLeast || text.front() != '.') return std::nullopt;
  text.remove_prefix(1);
  const auto number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

struct Found {
  std::uint64_t resumed = 0, part = 0;  // 0: of the first process, the whole file
};

std::optional<Found> found_in(const Names& names, std::string_view name) {
  constexpr std::string_view kResumed = ".resumed-";
  if (name.size() < names.stem.size() + names.ending.size()) return std::nullopt;
  if (!name.starts_with(names.stem) || !name.ends_with(names.ending)) return std::nullopt;
  name.remove_prefix(names.stem.size());
  name.remove_suffix(names.ending.size());
  Found found;
  if (name.starts_with(kResumed)) {
    name.remove_prefix(kResumed.size());
    const auto resumed = take_number(name);
    if (!resumed || *resumed == 0) return std::nullopt;
    found.resumed = *resumed;
  }
  const auto part = part_in(name);
  if (!part) return std::nullopt;
  found.part = *part;
  return found;
}

// The chunks of such a file are compressed, so only the library that wrote it is looked at.
bool is_part_of_mcap(const std::string& path, std::uint64_t number) {
  constexpr std::uint64_t kMost = 100'000;  // of parts; a date has more digits
  constexpr std::string_view kMagic = "\x89MCAP0\r\n";
  char begin[64] = "";
  std::ifstream(path, std::ios::binary).read(begin, sizeof begin - 1);
  const std::string_view text(begin, sizeof begin);
  return number < kMost && text.starts_with(kMagic) && text.find("lockstep") != text.npos;
}

// A part behind the first one has its first tick in its header. Of what a crash has left of one,
// the name decides.
bool is_part(const std::string& path, std::uint64_t number) {
  if (number == 1) return true;
  if (path.ends_with(".mcap")) return is_part_of_mcap(path, number);
  try {
    auto header = header_line(path);
    if (!header) return false;
    bool has_first_tick = false;
    JsonReader().read(*header, [&](JsonObject all) {
      all.each_field([&](std::string_view name, JsonValue) {
        has_first_tick |= name == lines::kHeader["first_tick"];
      });
    });
    return has_first_tick;
  } catch (const JsonError&) {
    return true;
  } catch (const CannotDecompress&) {
    return true;
  }
}

// In no order. A folder that cannot be read has none. Files that are not wanted are not looked at.
std::vector<Found> all_files(const Names& names, const std::function<bool(Found)>& is_wanted) {
  std::vector<Found> all;
  std::error_code none;
  const std::string folder = names.folder.empty() ? "." : names.folder;
  for (std::filesystem::directory_iterator it(folder, none), end; !none && it != end;
       it.increment(none)) {
    const auto found = found_in(names, it->path().filename().string());
    if (!found || !is_wanted(*found) || !it->is_regular_file(none)) continue;  // no pipe, no device
    if (found->part == 0 || is_part(it->path().string(), found->part)) all.push_back(*found);
  }
  return all;
}

// In their order, each once.
using Numbers = std::set<std::uint64_t>;

Numbers parts_in(const std::string& recording, std::uint64_t behind) {
  Numbers numbers;
  const auto is_wanted = [&](Found it) { return it.resumed == 0 && it.part > behind; };
  for (const Found& it : all_files(Names(recording), is_wanted)) numbers.insert(it.part);
  return numbers;
}

Numbers processes_in(const Names& names, std::uint64_t first) {
  Numbers numbers;
  const auto is_wanted = [&](Found it) { return it.resumed >= first; };
  for (const Found& it : all_files(names, is_wanted)) numbers.insert(it.resumed);
  return numbers;
}

// Adds the first of each gap, also of one behind `behind`, which is there if it is not 0.
Numbers with_gaps(Numbers numbers, std::uint64_t behind) {
  if (behind > 0 && !numbers.empty()) numbers.insert(behind);
  Numbers missing;
  for (const std::uint64_t it : numbers) {
    if (it != *numbers.rbegin() && !numbers.contains(it + 1)) missing.insert(it + 1);
  }
  numbers.merge(missing);
  numbers.erase(behind);
  return numbers;
}

std::vector<std::string> named(const Numbers& numbers,
                               const std::function<std::string(std::uint64_t)>& name) {
  std::vector<std::string> names;
  for (const std::uint64_t it : numbers) names.push_back(name(it));
  return names;
}

}  // namespace

std::string part_name(const std::string& recording, std::uint64_t number) {
  const std::size_t place = place_of_number(recording);
  return fmt::format("{}.{:04}{}", recording.substr(0, place), number, recording.substr(place));
}

std::vector<std::string> parts_that_exist(const std::string& recording) {
  return named(parts_in(recording, 0), [&](std::uint64_t it) { return part_name(recording, it); });
}

std::vector<std::string> parts_to_read(const std::string& recording, const std::string& behind) {
  const auto found = found_in(Names(recording), std::filesystem::path(behind).filename().string());
  const std::uint64_t last = found ? found->part : 0;
  return named(with_gaps(parts_in(recording, last), last),
               [&](std::uint64_t it) { return part_name(recording, it); });
}

std::vector<std::string> resumed_recordings(const std::string& recording,
                                            const std::string& behind) {
  const Names names(recording);
  const auto found = found_in(names, std::filesystem::path(behind).filename().string());
  const std::uint64_t last = found ? found->resumed : 0;
  return named(with_gaps(processes_in(names, last), last),
               [&](std::uint64_t it) { return names.whole(it); });
}

std::vector<std::string> files_that_exist(const std::string& recording) {
  std::vector<std::string> recordings = resumed_recordings(recording), files;
  recordings.insert(recordings.begin(), recording);
  for (const std::string& it : recordings) {
    std::error_code none;
    if (std::filesystem::is_regular_file(it, none)) files.push_back(it);
    std::ranges::move(parts_that_exist(it), std::back_inserter(files));
  }
  return files;
}

std::string name_of_resumed(const std::string& recording) {
  const Names names(recording);
  const Numbers processes = processes_in(names, 0);
  std::uint64_t next = processes.empty() ? 0 : *processes.rbegin() + 1;
  // In a folder that cannot be listed, each name can be looked at.
  for (std::error_code none; std::filesystem::is_regular_file(names.whole(next), none);) ++next;
  return names.whole(next);
}

}  // namespace lockstep::host
