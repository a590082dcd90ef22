#include "verify/counter_example.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "recording/write/recorder.h"
#include "runtime/deadlines.h"
#include "runtime/loop.h"
#include "system/descriptors.h"
#include "system/output_file.h"

namespace lockstep::host {
namespace {

// Says to a person who opens one of the files what it is for.
std::string heading(const Finding& finding) {
  std::string text = fmt::format("{}: {}", finding.name, finding.message);
  if (finding.repeats) text += fmt::format("; repeats from tick {}", *finding.repeats);
  return text;
}

std::optional<Problem> write_text(const std::string& path, const std::string& text) {
  OutputFile file(path);
  if (!file.error().empty()) return Problem{file.error()};
  if (!write_all(file.descriptor(), text) || !file.take_name()) {
    return Problem{fmt::format("cannot write '{}': {}", path, std::strerror(errno))};
  }
  return std::nullopt;
}

// Returns "" or why it cannot be written.
std::string record(const Tree& tree, const LeafScripts& scripts, const std::string& path,
                   const Finding& finding, const CounterExampleOptions& options) {
  Recorder recorder(tree, {.path = path,
                           .run = {.tree_file = options.tree_file,
                                   .rate_hz = options.rate,
                                   .arguments = options.arguments,
                                   .verify = heading(finding)}});
  if (!recorder.error().empty()) return recorder.error();
  VirtualClock clock;
  Run run(tree, {.period = deadline_of(1, options.rate), .virtual_time = true});
  Observer* const observers[] = {&recorder};
  LoopOptions loop;
  loop.rate = options.rate;
  loop.max_ticks = scripts.ticks;
  run_loop(run, clock, loop, observers);
  return recorder.error();
}

}  // namespace

Result<CounterExample> write_counter_example(const Tree& tree, const Finding& finding,
                                             Tracer& tracer, PlayedLeaves& played,
                                             const CounterExampleOptions& options) {
  CounterExample files{options.stem + ".jsonl", options.stem + ".leaves"};
  LeafScripts scripts = tracer.scripts(finding.run);
  scripts.rate = options.rate;
  if (auto error = write_text(files.leaves, "# " + heading(finding) + '\n' + to_text(scripts))) {
    return tl::unexpected(std::move(*error));
  }
  played.set_scripts(scripts);
  std::string error = record(tree, scripts, files.recording, finding, options);
  if (!error.empty()) return problem(std::move(error));
  return files;
}

}  // namespace lockstep::host
