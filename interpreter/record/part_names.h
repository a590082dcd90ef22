// The names of the files of one recording that is written in parts: run.0001.jsonl, run.0002.jsonl,
// … for run.jsonl.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::host {

// From 1 on.
std::string part_name(const std::string& recording, std::uint64_t number);

// Those that are there, in their order.
std::vector<std::string> parts_that_exist(const std::string& recording);

// Those of the runs that continued it after cuts, in their order.
std::vector<std::string> resumed_recordings(const std::string& recording);

// For the recording of a run that continues after a cut, where the one before it is still there:
// "run.resumed-1.jsonl", or the next number that is free. The same name where nothing is there.
std::string name_of_resumed(const std::string& recording);

}  // namespace lockstep::host
