// Entries of lockstep's own language in scripts: each has a type, from the ports that use it, from
// a
// ':=', or from its start value.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

// The start values, as written, of entries that no port uses.
using StartTexts = std::map<std::uint32_t, std::string_view>;

// Gives the entries that only scripts use their types. One that nothing declares is an error, but
// for those of `guessed`, which are used by unknown nodes: such an entry may have any type. Those
// of `later` get such a value while the tree runs, and have none before.
void declare_entries(Definition& definition, const StartTexts& starts, const Reporter& report,
                     std::span<const std::uint32_t> guessed = {}, const StartTexts& later = {});

}  // namespace lockstep::host
