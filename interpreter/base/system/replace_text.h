// The one function that changes a file which people keep, such as a tree, a scenario file or the
// source of a plugin.
#pragma once

#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

// Replaces `expected`, the bytes that were read from the file, by `text`, through a symbolic link
// if it is one. Owner, mode, access control list and hard links stay. A signal that ends the
// process waits until it is done.
//
// - If the file has another text by now, it keeps that: "has changed meanwhile".
// - The new text is written to a second file in the directory, which then exchanges its name with
//   the file. So a crash or a full disk leaves the old text or the new one. What a program saved
//   until the exchange is found after it, and gets its name back.
// - A file with several names (hard links), of another owner, or in a directory that cannot be
//   written is overwritten where it is. Its place on the disk is reserved first, and a copy of the
//   old text stays in the directory, if that is possible, until the new one is complete.
Result<void> replace_text(const std::string& path, std::string_view expected,
                          std::string_view text);

// A file that was not there. After a Problem it is not there either.
Result<void> create_text(const std::string& path, std::string_view text, mode_t mode = 0666);

}  // namespace lockstep::host
