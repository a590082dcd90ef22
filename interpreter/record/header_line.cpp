#include "record/header_line.h"

#include "base/compression/decompressed.h"
#include "record/lines.h"

namespace lockstep::host {

static_assert(kHeaderBegin.substr(2, 18) == lines::kHeader["lockstep_recording"]);

std::optional<std::string> header_line(const std::string& path) {
  DecompressedFile file(path);
  std::string line(kHeaderBegin.size(), '\0');
  file.text().read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(file.text().gcount()));
  if (line != kHeaderBegin.substr(0, line.size())) return std::nullopt;
  std::string rest;
  if (file.text()) std::getline(file.text(), rest);
  return line + rest;
}

}  // namespace lockstep::host
