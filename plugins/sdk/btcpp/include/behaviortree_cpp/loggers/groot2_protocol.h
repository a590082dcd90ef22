// Not in lockstep: the compiler says so.
#pragma once

#error \
    "lockstep has the protocol of Groot2 as an option, not as a header: 'lockstep run --groot2' shows a run there, --record run.jsonl records it"
