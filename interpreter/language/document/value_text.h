// Values of attributes as XML has them between the quotes.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// As it is written between two of `quote`.
std::string escaped(std::string_view value, char quote = '"');
// The same with the quotes.
std::string quoted(std::string_view value);

// `raw` with the value `value`: what both have at their begin and end stays as it is written.
std::string changed_value(std::string_view raw, std::string_view value, char quote);

}  // namespace lockstep::host
