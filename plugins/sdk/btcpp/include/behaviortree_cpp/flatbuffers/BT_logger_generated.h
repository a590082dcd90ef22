// Not in lockstep: the compiler says so.
#pragma once

#error \
    "lockstep has neither the logs nor the protocol of Groot: 'lockstep run --record run.jsonl' records a run, --view live shows it"
