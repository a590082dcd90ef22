// The page of the monitor: one file of HTML that shows a run or its recording in a browser. Its
// sources are in web/page/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "show/web/base64.h"
#include "show/web/gzip.h"

namespace lockstep::host {

// The page as it was built; `source` is an object of JSON that tells it where it finds the run.
std::string page_with_source(std::string_view source);

// Makes the page with a recording in it, which needs nothing else, while the recording is read:
// `sink` gets the pieces of the page in order.
class RecordingPage {
 public:
  // The bounds are those of the ticks that were asked for, if not all of the recording is there.
  explicit RecordingPage(Gzip::Sink sink, std::optional<std::uint64_t> from = {},
                         std::optional<std::uint64_t> to = {});

  // The next bytes of the recording.
  void add(std::string_view bytes) { gzip_.add(bytes); }
  // The recording ends here, and then the page does.
  void finish();

 private:
  const Gzip::Sink sink_;
  Base64 base64_;
  Gzip gzip_;
};

// The sources from which the page may load and run, for the header Content-Security-Policy. It is
// also in the page.
std::string_view page_policy();

}  // namespace lockstep::host
