// The element of a program's leaf type that has more ports than others: what the program is asked,
// and what it answers.
#pragma once

#include <span>
#include <string_view>

#include "core/element_types.h"
#include "lockstep/leaf.h"
#include "remote/json_lines/conversation.h"
#include "remote/json_lines/hello.h"
#include "remote/owned_descriptors.h"

namespace lockstep::host {

// Asks the program, which has no leaf yet. The type is that of `id` with the ports of the element,
// and `tables` keep it. A program that does not answer as it should is gone then.
tl::expected<const lockstep_leaf_type*, ElementRefusal> describe_element(
    Conversation& conversation, const Hello& hello, std::string_view id,
    std::span<const FixedText> fixed, OwnedDescriptors& tables);

}  // namespace lockstep::host
