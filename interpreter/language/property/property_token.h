// The words of a property.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tl/expected.hpp>

#include "language/property/property.h"

namespace lockstep::host {

struct PropertyToken {
  enum class Kind : std::uint8_t {
    End,
    Word,    // never, arm.running, left/arm
    Quoted,  // 'pick up', without the quotes
    Key,     // {key}, without the braces
    Number,
    Relation,
    Field,  // .running behind a Quoted, without the point
    Open,
    Close,
    Colon,
  };
  Kind kind = Kind::End;
  std::string_view text = {};
  std::size_t offset = 0;
  double number = 0;
  Relation relation = {};
};

// The token behind the blanks at `offset`, which moves behind it.
tl::expected<PropertyToken, PropertyError> next_property_token(std::string_view text,
                                                               std::size_t& offset);

// Whether the name of a node has characters that only stand in quotes.
bool needs_quotes(std::string_view name);

}  // namespace lockstep::host
