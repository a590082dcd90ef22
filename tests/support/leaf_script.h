// What a leaf of a test does, written in a line:
//   RRS           a letter for each tick it gets: R running, S success, F failure, as in
//                 status_letters; the last one stays
//   RRS...        the same, over and over
//   R.2R.5S       with the progress it reports after that tick; unchanged where none is written,
//                 0 at the start of an activation; R<nan> reports NaN
//   +.1  +.4,-.2  progress grows by .1 with each tick it gets (by .4, -.2, -.2, ...), and it
//                 succeeds in the tick in which it reaches 1
//   +.1/.2        the same, and falls by .2 in each tick that is withheld
//   +.1*.2        the same for a leaf that obeys a pace: it grows by so much of .1, and takes up .2
//   at
//                 least; one without it goes on as fast as ever
//   R~0,1         progress 0 in the first tick of the tree, then 1, whether ticked or not
// Wrong on purpose: X sets an error in tick, T throws in tick, B returns status 7, I returns 0;
// x and t do so in start. !halt (or pause, resume) at the end: sets an error there; ^halt: throws.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/event_log.h"

namespace lockstep::host::test {

struct LeafScript {
  struct Step {
    char letter;
    std::optional<double> progress;
  };
  std::vector<Step> steps;
  bool repeats = false;
  std::vector<double> growth;  // instead of steps
  double least_pace = 1;       // with growth
  double loss = 0;             // with growth: in each tick withheld
  std::vector<double> live;    // progress by the tick of the tree
  std::optional<Call> fails_in;
  bool throws = false;  // there
};

// Throws std::invalid_argument.
LeafScript parse_leaf_script(std::string_view text);

// Of each Status: "IRSF".
std::string_view status_letters();

// "1", ".5", "-.2" at the start of `text`, which is shortened by it.
double take_number(std::string_view& text);

}  // namespace lockstep::host::test
