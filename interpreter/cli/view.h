// What a person sees of a run while it goes on: the live view, plain lines or nothing.
#pragma once

#include <optional>
#include <string>

#include "observers/console_live.h"
#include "observers/console_plain.h"
#include "plugin/leaf_set.h"

namespace lockstep {

class View {
 public:
  // `mode` is auto, live, plain or none.
  View(const std::string& mode, const Tree& tree);

  // Null when there is nothing to show.
  Observer* observer();
  // A line for the person, whatever the view. Any thread.
  void print(const std::string& line);
  // Prints what leaves log.
  LeafLog leaf_log();
  // The last frame stays; from here on stderr can be written to directly.
  void close() { live_.reset(); }

  // Leaves the terminal usable. Async-signal-safe.
  static void last_words();

 private:
  std::optional<ConsoleLive> live_;
  std::optional<ConsolePlain> plain_;
};

}  // namespace lockstep
