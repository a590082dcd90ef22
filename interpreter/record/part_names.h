// The names of the files of one recording that is written in parts: run.0001.jsonl, run.0002.jsonl,
// … for run.jsonl.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::host {

// From 1 on.
std::string part_name(const std::string& recording, std::uint64_t number);

// Those that are there, in their order. A file with such a name is none if it is another recording,
// as "mission.20261128.jsonl" of a user who writes one for each day, or no recording at all.
std::vector<std::string> parts_that_exist(const std::string& recording);
// The same, and the first of each gap between them: who opens it can report that. Those behind that
// part, if it is one; the others are not looked at.
std::vector<std::string> parts_to_read(const std::string& recording,
                                       const std::string& behind = {});

// A run that continued after cuts has a recording of each process: run.jsonl, run.resumed-1.jsonl,
// …, each as one file or in parts. Those after the first, or behind that one, in their order, and
// the first of each gap between them.
std::vector<std::string> resumed_recordings(const std::string& recording,
                                            const std::string& behind = {});

// The files of all processes that are there, in their order.
std::vector<std::string> files_that_exist(const std::string& recording);

// For the recording of a run that continues after a cut: the name behind the last one that is
// there. The same name where nothing is there.
std::string name_of_resumed(const std::string& recording);

}  // namespace lockstep::host
