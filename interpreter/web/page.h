// The page of the monitor: one file of HTML that shows a run or its recording in a browser. Its
// sources are in web/page/.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// The page as it was built; `source` is an object of JSON that tells it where it finds the run.
std::string page_with_source(std::string_view source);
// The page with this recording in it, which needs nothing else.
std::string page_with_recording(std::string_view recording);

// What the page may load and run, for the header Content-Security-Policy. It is also in the page.
std::string_view page_policy();

}  // namespace lockstep::host
