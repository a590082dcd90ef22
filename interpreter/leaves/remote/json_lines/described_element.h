// The element of a program's leaf type that has more ports than others: what the program is asked,
// and what it answers.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/core/element_types.h"
#include "leaves/remote/json_lines/conversation.h"
#include "leaves/remote/owned_descriptors.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// The question to the program, as a line without its end; `type` is its leaf type.
std::string describe_request(const lockstep_leaf_type& type, std::span<const FixedText> fixed);
// The type of the element: `base` with the ports of the answer, which `tables` keep. Throws a
// JsonError.
tl::expected<const lockstep_leaf_type*, ElementRefusal> read_described(
    std::string& answer, const lockstep_leaf_type& base, OwnedDescriptors& tables);

// Asks the program, which has no leaf yet. One that does not answer as it should is gone then.
Result<std::string> ask_to_describe(Conversation& conversation, std::string_view request);

// An element that cannot be described, since its program is as `why` says.
ElementRefusal undescribed(std::string_view id, const Problem& why);

}  // namespace lockstep::host
