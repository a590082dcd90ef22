// Not in lockstep: the compiler says so.
#pragma once

#error "lockstep gives scripts to no C++ code: write a Script node or _skipIf in the tree, 'lockstep check' reads it"
