#include "scenario/report_text.h"

#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "base/core/shell_word.h"
#include "base/core/wording.h"
#include "base/terminal/style.h"

namespace lockstep::host {
namespace {

ScenarioOutcome outcome_of(const ScenarioReport& report) {
  if (!report.errors.empty()) return ScenarioOutcome::Invalid;
  if (report.was_stopped) return ScenarioOutcome::Stopped;
  return report.is_good() ? ScenarioOutcome::Passed : ScenarioOutcome::Failed;
}

std::string sign_of(ScenarioOutcome outcome, bool color) {
  constexpr std::string_view kSigns[] = {"ok  ", "FAIL", "BAD "};
  if (outcome == ScenarioOutcome::Stopped) return "stop";
  const Style style = outcome == ScenarioOutcome::Passed ? Style::Good : Style::Bad;
  return styled(kSigns[static_cast<std::size_t>(outcome)], style, color);
}

std::string render_errors(std::span<const Diagnostic> all, bool color) {
  std::string text;
  for (const Diagnostic& error : all) {
    if (error.severity == Severity::Error) text += render(error, color);
  }
  return text;
}

std::string what_came(const ReportedScenario& it) {
  if (it.runs == 0) return "all behaviors";
  if (it.runs > 1) return fmt::format("{}, {}", counted(it.runs, "run"), counted(it.ticks, "tick"));
  return counted(it.ticks, "tick");
}

}  // namespace

std::string_view to_string(ScenarioOutcome outcome) {
  constexpr std::string_view kTexts[] = {"passed", "failed", "invalid", "stopped"};
  return kTexts[static_cast<std::size_t>(outcome)];
}

ReportedScenario reported(const ScenarioReport& report) {
  const Sources& sources = report.file->sources;
  ReportedScenario it{.file = report.file->path,
                      .name = report.scenario->name,
                      .place = to_text(sources.locate(report.scenario->place)),
                      .outcome = outcome_of(report),
                      .runs = report.runs,
                      .ticks = report.ticks,
                      .seed = report.seed};
  for (const Diagnostic& error : report.errors) {
    if (error.severity != Severity::Error) continue;
    it.failures.push_back({to_text(error.location), error.message, {}});
    if (!error.hint.empty()) it.failures.back().more.push_back(error.hint);
  }
  for (const Surprise& surprise : report.surprises) {
    it.failures.push_back(
        {to_text(sources.locate_value(surprise.place)), surprise.message, surprise.more});
  }
  it.recording = report.recording;
  if (!it.recording.empty()) it.replay = "lockstep replay " + shell_word(it.recording);
  it.again = fmt::format("lockstep test {} --filter {}", shell_word(it.file), shell_word(it.name));
  return it;
}

std::string to_text(const ScenarioReport& report, std::size_t width, bool color,
                    std::span<const Diagnostic> told) {
  const ReportedScenario it = reported(report);
  const bool has_failed = it.outcome == ScenarioOutcome::Failed;
  std::string text =
      fmt::format("  {}  {:<{}}", sign_of(it.outcome, color), printable(it.name), width);
  if (has_failed || it.outcome == ScenarioOutcome::Passed) text += "  " + what_came(it);
  const std::string errors = render_errors(report.errors, color);
  const bool is_told = !errors.empty() && errors == render_errors(told, color);
  if (is_told) text += "  the same";
  while (text.ends_with(' ')) text.pop_back();
  text += '\n';
  if (!is_told) text += errors;
  if (report.errors.empty()) {
    for (const auto& failure : it.failures) {
      text += fmt::format("        {}: {}\n", failure.place, printable(failure.message));
      for (const std::string& line : failure.more) {
        text += fmt::format("          {}\n", printable(line));
      }
    }
  }
  if (has_failed && it.runs > 1) {
    const std::uint64_t run = 1 + it.seed - report.scenario->seed;  // each has the next seed
    text += fmt::format("        run {}, seed {}\n", run, it.seed);
  }
  if (!it.replay.empty()) text += fmt::format("        {}\n", it.replay);
  if (has_failed) text += fmt::format("        {}\n", it.again);
  return text;
}

void TestCounts::add(const ScenarioReport& report) {
  std::size_t* const counts[] = {&passed, &failed, &invalid, &stopped};
  ++*counts[static_cast<std::size_t>(outcome_of(report))];
  runs += report.runs;
  ticks += report.ticks;
}

std::string to_text(const TestCounts& counts) {
  const std::size_t all = counts.passed + counts.failed + counts.invalid + counts.stopped;
  std::string text = fmt::format("{}: {} passed", counted(all, "scenario"), counts.passed);
  if (counts.failed > 0) text += fmt::format(", {} failed", counts.failed);
  if (counts.invalid > 0) text += fmt::format(", {} invalid", counts.invalid);
  if (counts.stopped > 0) text += fmt::format(", {} stopped", counts.stopped);
  return text + fmt::format(", {:.2f} s\n", to_seconds(counts.took));
}

}  // namespace lockstep::host
