// The end of a tick's line, read again: moments, faults and entries, for those who count them. And
// the counts as a part of a line.
#pragma once

#include <cstdint>
#include <string>

#include "base/json/reader.h"

namespace lockstep::host {

class EventCounts;

class TickEndJson {
 public:
  // The end of a line: ],"faults":[[3,"threw"]],"entries":[[0,"1"]]}
  void read(std::string text, EventCounts& counts);

 private:
  JsonReader reader_;
};

// What goes before json_lines::kFullEnd: ,"counts":[[3,1,150,0,0,2,0],…],"written":[[0,12],…]
std::string counts_json(const EventCounts& counts, std::uint64_t tick);

}  // namespace lockstep::host
