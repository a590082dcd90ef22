// What mends a message of the check: changes of the text that it is about. The one list, for the
// quick fixes of editors and for `check`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "language/document/text_edit.h"
#include "language/document/tolerant.h"
#include "tree/catalog.h"

namespace lockstep::host {

struct Mend {
  std::string title;  // "Replace 'Sequnce' by 'Sequence'"
  TextEdit edit;      // of all bytes of the file
  // There is no other way to read what was meant. Else a person decides: the value is an example,
  // or several words are as near.
  bool is_certain = false;
};

// Of the messages about one file.
class Mends {
 public:
  // `tree` is of all bytes of the file, with a byte order mark if it has one; it and `catalog` must
  // outlive this.
  Mends(const TolerantTree& tree, const Catalog& catalog);

  // The bytes that a message of the file is about.
  ByteRange place_of(const Diagnostic& message) const;
  // The best first; none: no program knows one.
  std::vector<Mend> of(const Diagnostic& message) const;

 private:
  const TolerantTree& tree_;
  const Catalog& catalog_;
  std::size_t mark_;  // the places of messages are those without a byte order mark
  LineIndex lines_;
};

}  // namespace lockstep::host
