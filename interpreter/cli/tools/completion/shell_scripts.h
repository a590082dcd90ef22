// The script that each shell runs to complete a line: it asks `lockstep completion words`.
#pragma once

namespace lockstep::host {

extern const char* const kBashCompletion;
extern const char* const kZshCompletion;
extern const char* const kFishCompletion;

}  // namespace lockstep::host
