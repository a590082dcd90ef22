// How the commands talk to a person: messages go to stderr, in color where that is a terminal.
#pragma once

#include <cstdio>
#include <string_view>

#include "core/diagnostics.h"

namespace lockstep {

bool is_terminal(std::FILE* file);
// A terminal, and neither NO_COLOR nor TERM=dumb.
bool wants_color(std::FILE* file);

void print_error(std::string_view message, std::string_view hint = {});

// Those of at least this severity, sorted, and how many errors there are when more than one.
void print_diagnostics(Diagnostics& diagnostics, Severity least, std::FILE* out);

// True when all that was printed to stdout has arrived; else says why not.
bool flush_stdout();

}  // namespace lockstep
