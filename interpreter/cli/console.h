// The output of the commands: messages go to stderr, in color on a terminal, and results to stdout.
// Nothing here throws when output cannot be written.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/core/diagnostics.h"
#include "base/core/problem.h"

namespace lockstep::host {

bool is_terminal(int file);
// A terminal, and neither NO_COLOR nor TERM=dumb.
bool wants_color(int file);

void print_error(std::string_view message, std::string_view hint = {});
// Prints it. Returns kExitUsage.
int refuse(const Problem& problem);
void print_note(std::string_view message, std::string_view hint = {});

// Those of at least this severity, sorted, and how many errors there are when more than one.
void print_diagnostics(Diagnostics& diagnostics, Severity least);

// "", or "12 lines of stderr are lost: nobody read them", after waiting for the reader so long.
std::string lost_messages(std::chrono::nanoseconds patience);

// From now on stdout is for results only: output of plugins goes to stderr. Called by each command
// that opens plugins.
void keep_stdout_for_results();
// The descriptor of stdout, also after that.
int results_file();
// The columns of the terminal that shows the results; no limit where they go elsewhere.
std::size_t results_width();
// Writes the results of a command to stdout. Returns kExitSuccess, or the exit code for an
// incomplete write. Reports the reason, unless the reader has gone. A signal ends the wait for a
// reader, but not the one that has stopped the command before.
int write_results(std::string_view text);
int write_results(std::string_view text, int stopped_by);

}  // namespace lockstep::host
