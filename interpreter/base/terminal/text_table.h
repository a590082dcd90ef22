// Rows of text in columns that are aligned, with two blanks between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::host {

using TableRow = std::vector<std::string>;

// The first `left` columns are aligned to the left, the others to the right. A row may have
// fewer columns than others. The texts are printable() already. A table that is wider than `width`
// goes on in another one below it, which has the first `left` columns again.
std::string text_table(const std::vector<TableRow>& rows, std::size_t left,
                       std::size_t width = SIZE_MAX);

}  // namespace lockstep::host
