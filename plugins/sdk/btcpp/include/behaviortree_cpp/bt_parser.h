// Not in lockstep: the compiler says so.
#pragma once

#error "lockstep has no parser to derive from: BT::BehaviorTreeFactory loads trees"
