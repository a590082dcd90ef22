// The kinds of messages: what each code means, and what to do. `lockstep explain` and
// docs/messages.md show them.
#pragma once

#include <span>
#include <string_view>

namespace lockstep::host {

struct MessageKind {
  std::string_view code;     // as in "unknown-node"_code
  std::string_view meaning;  // one or two sentences
  std::string_view mend;     // what to do
  // A tree whose check has this message and no other; "": it comes from elsewhere, or needs more
  // than a tree.
  std::string_view example = {};
};

// By code.
std::span<const MessageKind> message_kinds();

}  // namespace lockstep::host
