// A random document for BehaviorTree.CPP, as the engine runs it.
#pragma once

#include "engine/tree.h"
#include "property/btcpp_random.h"

namespace lockstep::host::test::law {

// Fails the test for a document that does not load.
Tree tree_of(const Document& document);

}  // namespace lockstep::host::test::law
