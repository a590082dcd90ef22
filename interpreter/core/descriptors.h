// What every write of the program relies on: descriptors 0 to 2 that exist, a write that is whole,
// and one that never waits.
#pragma once

#include <string_view>

namespace lockstep {

// The first statement of main. A descriptor of 0 to 2 that is closed becomes /dev/null, or the next
// file that is opened would get its number, and our output would land in it. Reading such a stdin
// and writing such a stdout fails; what is written to such a stderr is gone.
void hold_standard_descriptors() noexcept;

// From here on a write that fails returns an error: neither a reader that goes away (SIGPIPE) nor
// the limit of a file's size (SIGXFSZ) ends the process.
void make_writes_fail() noexcept;

// Waits for whoever reads. False, with errno, when not all was written.
bool write_all(int file, std::string_view text) noexcept;
// Waits no longer than until `gives_up`: errno is EINTR then.
bool write_all(int file, std::string_view text, bool (*gives_up)()) noexcept;

// Writes what the reader takes at once; the rest is gone. Async-signal-safe.
void write_now(int file, std::string_view text) noexcept;

}  // namespace lockstep
