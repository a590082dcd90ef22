// Basic output: ensures that descriptors 0 to 2 exist, and has a write that completes and one that
// never waits.
#pragma once

#include <string_view>

namespace lockstep::host {

// The first statement of main. Opens /dev/null for a closed descriptor of 0 to 2. Otherwise the
// next opened file would get its number, and output would go to that file. Reading such a stdin and
// writing such a stdout fails; output to such a stderr is lost.
void hold_standard_descriptors() noexcept;

// From now on a failed write returns an error. Neither a closed pipe (SIGPIPE) nor the file size
// limit (SIGXFSZ) ends the process.
void make_writes_fail() noexcept;

// Waits for the reader. Returns false, with errno, if not everything was written.
bool write_all(int file, std::string_view text) noexcept;
// Stops waiting when `gives_up` is true; errno is EINTR then.
bool write_all(int file, std::string_view text, bool (*gives_up)()) noexcept;

// Writes what the reader accepts at once and discards the rest. Async-signal-safe.
void write_now(int file, std::string_view text) noexcept;

}  // namespace lockstep::host
