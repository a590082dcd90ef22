#include "cli/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace lockstep {

bool is_terminal(std::FILE* file) {
  return isatty(fileno(file)) == 1;
}

bool wants_color(std::FILE* file) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool refused = no_color != nullptr && *no_color != '\0';
  return !refused && is_terminal(file) &&
         (terminal == nullptr || std::strcmp(terminal, "dumb") != 0);
}

void print_error(std::string_view message, std::string_view hint) {
  Diagnostic diagnostic;
  diagnostic.location.file = "lockstep";
  diagnostic.message = message;
  diagnostic.hint = hint;
  fmt::print(stderr, "{}", render(diagnostic, wants_color(stderr)));
}

void print_diagnostics(Diagnostics& diagnostics, Severity least, std::FILE* out) {
  diagnostics.sort();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.severity > least) continue;
    Diagnostic shown = diagnostic;
    if (shown.location.file.empty()) shown.location.file = "lockstep";
    fmt::print(out, "{}", render(shown, wants_color(out)));
  }
  const std::size_t errors = diagnostics.count(Severity::Error);
  if (errors > Diagnostics::kMaxKept) {
    fmt::print(out, "{} errors, of which {} are shown\n", errors, Diagnostics::kMaxKept);
  } else if (errors > 1) {
    fmt::print(out, "{} errors\n", errors);
  }
}

bool flush_stdout() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  print_error(fmt::format("cannot write to stdout: {}", std::strerror(errno)));
  return false;
}

}  // namespace lockstep
