#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "cli/doctor/symptoms.h"
#include "run/realtime.h"

namespace lockstep::host {

namespace {

// Docker and podman leave a file; podman and systemd-nspawn set the variable.
bool is_container() {
  return access("/.dockerenv", F_OK) == 0 || access("/run/.containerenv", F_OK) == 0 ||
         std::getenv("container") != nullptr;
}

}  // namespace

// A thread tries it, as a run would: limits and capabilities do not say what a container forbids.
void look_at_rights(const Patient& patient, Symptoms& symptoms) {
  using Grade = Symptom::Grade;
  const RealtimeOptions wanted{.realtime = true};
  std::vector<Problem> problems;
  std::thread([&] { problems = apply_realtime(wanted); }).join();
  munlockall();
  const Grade grade = patient.realtime ? Grade::Trouble : Grade::Note;
  for (const Problem& problem : problems)
    symptoms.push_back({"--realtime", grade, problem.message, problem.hint});
  if (!problems.empty() && is_container())
    symptoms.push_back({"container", grade, "its limits are those with which it was started",
                        "docker run --ulimit rtprio=90 --ulimit memlock=-1"});
  if (problems.empty())
    symptoms.push_back({"--realtime", Grade::Good, "a real-time priority and locked memory"});
}

}  // namespace lockstep::host
