// Not in lockstep: the compiler says so.
#pragma once

#error \
    "lockstep has no polymorphic casts: give the port the type of the base, std::shared_ptr<Base>"
