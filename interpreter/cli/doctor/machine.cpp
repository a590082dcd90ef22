#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "base/core/wording.h"
#include "cli/doctor/symptoms.h"

namespace lockstep::host {
namespace {

using Grade = Symptom::Grade;
namespace fs = std::filesystem;

// "" when there is no such file.
std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

Symptom look_at_governor() {
  std::map<std::string, int> governors;
  std::error_code error;
  for (fs::directory_iterator it("/sys/devices/system/cpu", error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = first_line(it->path() / "cpufreq/scaling_governor");
    if (!name.empty()) ++governors[name];
  }
  if (governors.empty()) return {"governor", Grade::Good, "the system does not change frequencies"};
  std::string text;
  for (const auto& [name, count] : governors)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, count);
  if (governors.size() == 1 && governors.contains("performance"))
    return {"governor", Grade::Good, text};
  return {"governor", Grade::Note, text + ": a processor that wakes up is slow at first",
          "sudo cpupower frequency-set --governor performance   (package linux-cpupower)"};
}

Symptom look_at_clock() {
  const std::string source =
      first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource");
  const bool is_slow =
      source == "hpet" || source == "acpi_pm" || source == "jiffies" || source == "refined-jiffies";
  if (is_slow)
    return {"clock source", Grade::Trouble, source + ": to read the time is slow",
            "boot with clocksource=tsc tsc=reliable, if the processor's counter is good"};
  return {"clock source", Grade::Good, source.empty() ? "the system does not report it" : source};
}

Symptom look_at_resolution() {
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  if (resolution.tv_sec == 0 && resolution.tv_nsec <= 1000)
    return {"timers", Grade::Good, fmt::format("resolution {} ns", resolution.tv_nsec)};
  return {"timers", Grade::Trouble,
          fmt::format("resolution {} ms: sleeps end late",
                      rounded(double(resolution.tv_sec) * 1e3 + double(resolution.tv_nsec) / 1e6)),
          "use a kernel with CONFIG_HIGH_RES_TIMERS"};
}

// As Debian calls it.
#ifdef __aarch64__
constexpr const char* kArchitecture = "arm64";
#else
constexpr const char* kArchitecture = "amd64";
#endif

Symptom look_at_kernel(const Patient& patient) {
  if (first_line("/sys/kernel/realtime") == "1") return {"kernel", Grade::Good, "PREEMPT_RT"};
  return {"kernel", patient.realtime ? Grade::Note : Grade::Good,
          "not PREEMPT_RT: usually on time, without a promise",
          patient.realtime
              ? fmt::format("sudo apt-get install linux-image-rt-{}, if a late tick is a danger",
                            kArchitecture)
              : ""};
}

Symptom look_at_load() {
  double loads[1] = {0};
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  if (getloadavg(loads, 1) != 1) return {"load", Grade::Note, "the system does not report it"};
  const std::string text = fmt::format("{} on {} processor{}", rounded(loads[0]), processors,
                                       processors == 1 ? "" : "s");
  if (loads[0] <= processors) return {"load", Grade::Good, text};
  return {"load", Grade::Note, text + ": threads wait for a processor",
          "end what is not needed, or give the run a processor: --cpu, --helper-cpu"};
}

// How late this thread wakes up, in ns, sorted.
std::vector<std::int64_t> measure_lateness(double rate) {
  constexpr double kLongest = 0.25;  // seconds, for all of it
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  };
  const auto period = static_cast<std::int64_t>(1e9 / std::max(rate, 20.0));
  const auto count = static_cast<std::int64_t>(kLongest * 1e9) / period;
  std::vector<std::int64_t> late;
  const std::int64_t start = now();
  for (std::int64_t i = 1; i <= std::max<std::int64_t>(count, 1); ++i) {
    const std::int64_t due = start + i * period;
    const timespec until{due / 1'000'000'000, due % 1'000'000'000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    late.push_back(now() - due);
  }
  std::ranges::sort(late);
  return late;
}

Symptom look_at_lateness(const Patient& patient) {
  const auto late = measure_lateness(patient.rate);
  const auto worst = static_cast<double>(late.back());
  const std::string text = fmt::format(
      "{} ticks at {} Hz: median {} us late, worst {} us", late.size(), rounded(patient.rate),
      rounded(static_cast<double>(late[late.size() / 2]) / 1e3), rounded(worst / 1e3));
  if (worst < 0.5e9 / patient.rate) return {"lateness", Grade::Good, text};
  return {"lateness", Grade::Trouble, text + ", more than half a period",
          "a lower --rate; or a machine with less load; or --realtime and --cpu"};
}

}  // namespace

void look_at_machine(const Patient& patient, Symptoms& symptoms) {
  symptoms.push_back(look_at_governor());
  symptoms.push_back(look_at_clock());
  symptoms.push_back(look_at_resolution());
  symptoms.push_back(look_at_kernel(patient));
  symptoms.push_back(look_at_load());
  symptoms.push_back(look_at_lateness(patient));
}

}  // namespace lockstep::host
