// How the commands talk: messages go to stderr, in color where that is a terminal, and results to
// stdout. Nothing here throws because something cannot be written.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostics.h"

namespace lockstep {

bool is_terminal(int file);
// A terminal, and neither NO_COLOR nor TERM=dumb.
bool wants_color(int file);

void print_error(std::string_view message, std::string_view hint = {});

// Those of at least this severity, sorted, and how many errors there are when more than one.
void print_diagnostics(Diagnostics& diagnostics, Severity least);

// "", or "12 lines of stderr are lost: nobody read them", after waiting a while for the reader.
std::string lost_messages();

// Stdout is for results alone from here on: what plugins print goes to stderr. For each command
// that opens plugins.
void keep_stdout_for_results();
// The descriptor of stdout, also after that.
int results_file();
// Writes what a command was asked for to stdout. The exit code: kExitSuccess, or what to end with
// because not all of it has arrived. It says why, unless nobody wants to read on.
// A signal ends the wait for a reader, but not the one that has stopped the command before.
int write_results(std::string_view text);
int write_results(std::string_view text, int stopped_by);

}  // namespace lockstep
