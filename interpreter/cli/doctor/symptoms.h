// `lockstep doctor` looks at causes and reports symptoms. Each source beside this has a part of
// them.
#pragma once

#include <string>
#include <vector>

#include "cli/load/load_options.h"

namespace lockstep::host {

struct Symptom {
  enum class Grade {
    Good,
    Note,     // it does no harm to the run that is asked about
    Trouble,  // it does
  };
  std::string subject;
  Grade grade = Grade::Good;
  std::string found;
  std::string remedy = {};  // "": there is nothing to do
};
using Symptoms = std::vector<Symptom>;

// The run that is to be possible here.
struct Patient {
  double rate = 100;
  bool realtime = false;
  PluginOptions plugins = {};
};

// Processors, clocks, the kernel, how late the machine wakes a thread.
void look_at_machine(const Patient& patient, Symptoms& symptoms);
// A real-time priority, locked memory.
void look_at_rights(const Patient& patient, Symptoms& symptoms);
// Plugins, and the libraries and programs that some commands need.
void look_at_parts(const Patient& patient, Symptoms& symptoms);

}  // namespace lockstep::host
