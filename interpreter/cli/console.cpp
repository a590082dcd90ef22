#include "cli/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "base/system/descriptors.h"
#include "base/terminal/outlet.h"
#include "base/terminal/terminal.h"
#include "cli/exit_code.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

int g_results = STDOUT_FILENO;

}  // namespace

bool is_terminal(int file) {
  return isatty(file) == 1;
}

bool wants_color(int file) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool refused = no_color != nullptr && *no_color != '\0';
  return !refused && is_terminal(file) && can_draw();
}

namespace {

void print(Severity severity, std::string_view message, std::string_view hint) {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.location.file = "lockstep";
  diagnostic.message = message;
  diagnostic.hint = hint;
  messages().say(render(diagnostic, wants_color(STDERR_FILENO)));
}

}  // namespace

void print_error(std::string_view message, std::string_view hint) {
  print(Severity::Error, message, hint);
}

int refuse(const Problem& problem) {
  print_error(problem.message, problem.hint);
  return kExitUsage;
}

void print_note(std::string_view message, std::string_view hint) {
  print(Severity::Note, message, hint);
}

void print_diagnostics(Diagnostics& diagnostics, Severity least) {
  const bool color = wants_color(STDERR_FILENO);
  diagnostics.sort();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.severity > least) continue;
    Diagnostic shown = diagnostic;
    if (shown.location.file.empty()) shown.location.file = "lockstep";
    messages().say(render(shown, color));
  }
  const std::size_t errors = diagnostics.count(Severity::Error);
  if (errors > Diagnostics::kMaxKept) {
    messages().say(
        fmt::format("{} errors, of which {} are shown\n", errors, Diagnostics::kMaxKept));
  } else if (errors > 1) {
    messages().say(fmt::format("{} errors\n", errors));
  }
}

std::string lost_messages(std::chrono::nanoseconds patience) {
  const Outlet::Loss lost = messages().settle(patience);
  if (lost.lines == 0) return {};
  return fmt::format("{} {} of stderr {} lost: {}", lost.lines, lost.lines == 1 ? "line" : "lines",
                     lost.lines == 1 ? "is" : "are",
                     lost.reason == 0 ? "no process read them" : std::strerror(lost.reason));
}

void keep_stdout_for_results() {
  if (g_results != STDOUT_FILENO) return;
  const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (copy < 0) return;
  g_results = copy;
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

int results_file() {
  return g_results;
}

std::size_t results_width() {
  return is_terminal(g_results) ? terminal_size(g_results).width : SIZE_MAX;
}

int write_results(std::string_view text) {
  return write_results(text, StopSignals::received());
}

int write_results(std::string_view text, int stopped_by) {
  const auto is_stopped = [] { return StopSignals::received() != 0; };
  const bool written =
      stopped_by == 0 ? write_all(g_results, text, is_stopped) : write_all(g_results, text);
  if (written) return kExitSuccess;
  if (errno == EPIPE) return kExitSignal + SIGPIPE;
  if (errno == EINTR) return kExitSignal + StopSignals::received();
  print_error(fmt::format("cannot write to stdout: {}", std::strerror(errno)));
  return kExitUsage;
}

}  // namespace lockstep::host
