// The entries of one tree, as the texts use them: who writes them, and which type they have.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "author/server/features/names.h"

namespace lockstep::host {

struct EntryFacts {
  std::string_view name;
  std::vector<const NamePlace*> places;

  // The first port that says a type; null: nobody does.
  const Parameter* typed() const;
  std::string type_text() const;  // "double", or "entry" where nobody says a type
  // Whether a value of it fits; null: nobody knows what is expected.
  bool may_be(const Parameter* wanted) const;
};

// In the order in which they are written.
std::vector<EntryFacts> entries_of(const Names& names, const TolerantElement* tree);

}  // namespace lockstep::host
