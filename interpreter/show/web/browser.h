// The browser of the user.
#pragma once

#include <string>

namespace lockstep::host {

// Opens a link in it, without waiting. False: there is no xdg-open, which knows the browser.
bool open_in_browser(const std::string& link);

}  // namespace lockstep::host
