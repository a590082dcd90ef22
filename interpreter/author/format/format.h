// The canonical layout of a tree file, a scenario file or a leaf file: an edit that changes blanks
// between tags and between attributes, and the indentation of comments. Values, texts and quotes
// stay as they are written. docs/authoring.md has the rules.
#pragma once

#include <cstddef>

#include "base/core/problem.h"
#include "language/document/document.h"
#include "language/document/text_edit.h"

namespace lockstep::host {

struct FormatOptions {
  std::size_t width = 100;       // attributes that would be beyond it go into the next line
  bool sort_attributes = false;  // ID and name first, then by name
};

// Fails only if the elements would not be the same afterwards, which is a bug. The second time it
// is empty.
Result<TextEdit> format(const Document& document, const FormatOptions& options = {});

}  // namespace lockstep::host
