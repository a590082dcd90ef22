#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/json/json.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/doctor/symptoms.h"
#include "cli/exit_code.h"

namespace lockstep::host {
namespace {

using Grade = Symptom::Grade;

struct DoctorOptions {
  Patient patient;
  bool json = false;
};

const char* name_of(Grade grade) {
  if (grade == Grade::Good) return "ok";
  return grade == Grade::Note ? "note" : "problem";
}

std::string as_text(const Symptoms& symptoms) {
  std::string text;
  for (const Symptom& it : symptoms) {
    text += fmt::format("{:<8} {:<20} {}\n", name_of(it.grade), it.subject, it.found);
    if (!it.remedy.empty()) text += fmt::format("{:<8} {:<20} -> {}\n", "", "", it.remedy);
  }
  return text;
}

std::string as_json(const Symptoms& symptoms) {
  std::vector<Json> list;
  for (const Symptom& it : symptoms) {
    list.push_back(Json{{"subject", it.subject},
                        {"grade", name_of(it.grade)},
                        {"found", it.found},
                        {"remedy", it.remedy}});
  }
  return Json{{"findings", list}}.printable() + "\n";
}

int doctor(const DoctorOptions& options) {
  Symptoms symptoms;
  look_at_machine(options.patient, symptoms);
  look_at_rights(options.patient, symptoms);
  look_at_parts(options.patient, symptoms);
  const int code = write_results(options.json ? as_json(symptoms) : as_text(symptoms));
  const bool is_problem =
      std::ranges::any_of(symptoms, [](const auto& it) { return it.grade == Grade::Trouble; });
  return first_failure(code, is_problem ? kExitFailure : kExitSuccess);
}

std::function<int()> define_doctor(CLI::App& app) {
  const auto options = std::make_shared<DoctorOptions>();
  app.add_option("--rate", options->patient.rate, "The rate to keep, in ticks per second")
      ->type_name("HZ")
      ->check(number_between(0.001, 100000.0))
      ->capture_default_str();
  app.add_flag("--realtime", options->patient.realtime,
               "Check also what `run --realtime` needs: if it is missing, it is a problem");
  app.add_option("--plugin-path", options->patient.plugins.directories,
                 "Search plugins in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_flag("--json", options->json, "Print the findings as JSON");
  return [options] { return doctor(*options); };
}

}  // namespace

extern const Command kDoctorCommand{
    "doctor", "Check whether this machine can keep the rate of a run, and what is missing",
    "Each line is ok, note (harmless for this run) or problem, with what to do.\n"
    "It measures for a quarter of a second how late the machine wakes a thread.\n"
    "\n"
    "Exit code: 0 no problem, 1 problem, 2 usage.\n"
    "\n"
    "Examples:\n"
    "  lockstep doctor\n"
    "  lockstep doctor --rate 1000 --realtime",
    define_doctor};

}  // namespace lockstep::host
