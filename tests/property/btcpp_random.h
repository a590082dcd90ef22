// Random documents for BehaviorTree.CPP: the same seed, the same document.
#pragma once

#include <cstdint>
#include <string>

#include "property/btcpp_reference.h"

namespace lockstep::host::test::law {

Document random_document(std::uint64_t seed);

// As a file, and the scripts of its leaves by name, as ScriptedRun reads them.
std::string to_xml(const Document& document);
std::string leaves_text(const Document& document);

}  // namespace lockstep::host::test::law
