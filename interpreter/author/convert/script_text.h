// A script in the words of the other language.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "author/convert/number_names.h"
#include "language/expression/expression.h"

namespace lockstep::host {

// Text that is not a script is returned as it is: the check of the tree reports it. An error: the
// other language cannot say it.
tl::expected<std::string, Expression::Error> script_to_theirs(std::string_view script);
tl::expected<std::string, Expression::Error> script_to_ours(std::string_view script,
                                                            const NumberNames& numbers);

}  // namespace lockstep::host
