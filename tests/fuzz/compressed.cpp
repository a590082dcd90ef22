// Any bytes as a compressed recording, and as a table of frames: they are read to their end or to
// an error, and where there is no table, from every place as from the begin. What ZstdFrames writes
// of any text is that text.
#include <cstdint>
#include <sstream>
#include <string>

#include "base/compression/decompressed.h"
#include "base/compression/seek_table.h"
#include "base/compression/zstd_frames.h"
#include "fuzz/require.h"
#include "record/read/recording_reader.h"

namespace fuzz_compressed_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

struct Text {
  explicit Text(const std::string& file) : in(file), buffer(*in.rdbuf()), text(&buffer) {
    text.exceptions(std::ios_base::badbit);
  }
  std::istringstream in;
  Decompressed buffer;
  std::istream text;
};

// From here on; none: it is damaged.
std::optional<std::string> rest(std::istream& in) {
  try {
    std::string text;
    char part[5000];
    while (in.read(part, sizeof part) || in.gcount() > 0) {
      text.append(part, static_cast<std::size_t>(in.gcount()));
    }
    return text;
  } catch (const CannotDecompress&) {
    return std::nullopt;
  }
}

bool has_table(const std::string& file) {
  return file.size() >= kSeekFooter && seek_table_size(file.substr(file.size() - kSeekFooter));
}

void read(const std::string& file) {
  Text all(file);
  const auto text = rest(all.text);
  // 16 MiB and 256 times as much, and a block.
  require(!text || text->size() <= (17u << 20) + 256 * file.size());
  Text some(file);
  try {
    some.text.seekg(0, std::ios_base::end);
    const auto size = static_cast<std::streamoff>(some.text.tellg());
    for (const std::streamoff place : {size / 2, std::streamoff{0}, size - 1}) {
      some.text.clear();
      if (place < 0 || !some.text.seekg(place)) continue;
      const auto part = rest(some.text);
      if (text && !has_table(file)) require(part == text->substr(static_cast<std::size_t>(place)));
    }
  } catch (const CannotDecompress&) {
    require(!text || has_table(file));
  }
  Text recording(file);
  RecordingReader reader(recording.text, "fuzz.zst");
  reader.skip_to(2);
  while (reader.next()) {
  }
}

void read_table(const std::string& bytes) {
  const auto frames = read_seek_table(bytes);
  if (!frames) return;
  require(frames->size() * sizeof(FrameSize) <= bytes.size());
  const auto again = read_seek_table(seek_table(*frames));
  require(again && again->size() == frames->size());
}

void write(const std::string& text) {
  constexpr std::size_t kPiece = 4096;
  ZstdFrames frames(kPiece);
  std::string file;
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    file += frames.add(std::string_view(text).substr(at, kPiece));
    frames.make_room();
    if (at % 3 == 1) file += frames.end();
  }
  file += frames.end();
  if (file.empty()) return;
  file += frames.table();
  Text all(file);
  require(rest(all.text) == text);
  Text half(file);
  const std::size_t place = text.size() / 2;
  require(static_cast<bool>(half.text.seekg(static_cast<std::streamoff>(place))));
  require(rest(half.text) == text.substr(place));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  read_table(bytes);
  write(bytes);
  return 0;
}

}  // namespace fuzz_compressed_target
