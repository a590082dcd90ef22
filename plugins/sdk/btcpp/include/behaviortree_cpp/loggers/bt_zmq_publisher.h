// Not in lockstep: the compiler says so.
#pragma once

#error \
    "lockstep has no publisher for Groot 1: Groot2Publisher of loggers/groot2_publisher.h shows a tree in Groot2"
