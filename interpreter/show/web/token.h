// The secret of the monitor, which its clients must know: a number that nobody can guess, as text.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

std::string make_token();
// In a time that says nothing of where they differ.
bool is_token(std::string_view token, std::string_view text);

}  // namespace lockstep::host
