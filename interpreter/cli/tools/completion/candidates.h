// The words that could end a command line: from the options that the commands have, and from
// the tree or the recording that the line names. No plugin is loaded, and no program started.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lockstep::host {

struct Candidate {
  std::string word;
  std::string about = {};  // "": the word says it
};

struct Candidates {
  std::vector<Candidate> words;
  // The names of files that could stand there too, as the scripts of the shells read it: "",
  // ":files" with the ends that names have, or ":directories".
  std::string files = {};
};

// `words` are those behind "lockstep". The last one is what is there of the word to complete.
Candidates candidates(std::span<const std::string> words);

}  // namespace lockstep::host
