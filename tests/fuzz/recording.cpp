// Any text as a recording: is read to its end or to an error.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "observers/recording_csv.h"
#include "observers/recording_info.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockstep;
  const std::string text(reinterpret_cast<const char*>(data), size);
  static std::FILE* const nowhere = std::fopen("/dev/null", "w");
  for (const bool csv : {true, false}) {
    std::istringstream in(text);
    RecordingReader reader(in, "fuzz.jsonl");
    if (csv) {
      write_csv(reader, nowhere);
    } else {
      write_info(reader, nowhere);
    }
    if (reader.error().empty() && reader.next()) std::abort();  // all ticks are read
  }
  return 0;
}
