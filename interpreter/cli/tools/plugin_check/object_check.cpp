#include "cli/tools/plugin_check/object_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>

#include "base/core/wording.h"
#include "base/system/descriptors.h"
#include "base/system/pipe.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/plugin_check/leaf_examiner.h"
#include "leaves/remote/child_process.h"
#include "run/plugin_thread.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kDeinit = "deinit";
// The first letter of a line says what it is.
constexpr char kGood = '+', kWrong = '-', kBegins = '>', kEnds = '.';

void say(char what, std::string_view text) {
  std::string line = fmt::format("{}{}\n", what, text);
  std::ranges::replace(line.begin(), line.end() - 1, '\n', ' ');
  if (!write_all(kFindings, line)) _exit(kExitUsage);  // the command has gone
}

void say_errors(const Diagnostics& diagnostics) {
  for (const Diagnostic& it : diagnostics.all()) {
    if (it.severity != Severity::Error) continue;
    say(kWrong, it.hint.empty() ? it.message : fmt::format("{}; {}", it.message, it.hint));
  }
}

// One child, from its first line to its end.
class Part {
 public:
  Part(Conformance& result, std::size_t first) : result_(result), leaf_(first) {}

  // Takes a line. False: there is no such line.
  void take(std::string_view line) {
    if (line.empty()) return;
    const std::string_view text = line.substr(1);
    if (line[0] == kGood || line[0] == kWrong) {
      result_.steps.push_back({line[0] == kGood, std::string(text)});
    } else if (line[0] == kBegins) {
      const auto end = std::from_chars(text.data(), text.data() + text.size(), leaf_).ptr;
      what_ = text.substr(std::min(static_cast<std::size_t>(end - text.data()) + 1, text.size()));
      has_begun_ = true;
    } else if (line[0] == kEnds) {
      has_ended_ = true;
    }
  }

  // The child has ended. Returns the leaf at which another one is to begin; none: all is done.
  std::optional<std::size_t> end(const std::string& how) {
    if (has_ended_) return std::nullopt;
    if (!has_begun_) {
      result_.steps.push_back({false, "its process " + how + " while it was loaded"});
      return std::nullopt;
    }
    result_.steps.push_back(
        {false, fmt::format("{}: its process {}; the report is on stderr", what_, how)});
    return what_ == kDeinit ? std::nullopt : std::optional(leaf_ + 1);
  }

 private:
  Conformance& result_;
  std::size_t leaf_;
  std::string what_;  // is examined
  bool has_begun_ = false, has_ended_ = false;
};

void read_lines(int descriptor, Part& part) {
  std::string text;
  char buffer[4096];
  for (ssize_t size; (size = read(descriptor, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(size));
    for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
      part.take(std::string_view(text).substr(0, end));
    }
  }
}

// By its path: behind /proc/self/exe there may be another program, as valgrind's.
std::string own_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  return !error && std::filesystem::exists(path, error) ? path.string() : "/proc/self/exe";
}

std::optional<std::size_t> run_part(const std::string& file, const PluginOptions& options,
                                    std::size_t first, Conformance& result) {
  Pipe findings;
  if (!findings.open()) {
    result.steps.push_back({false, "cannot be examined: there is no pipe"});
    result.has_started = false;
    return std::nullopt;
  }
  ChildProcess child;
  const ChildProcess::Given given[] = {{findings.writing.number(), kFindings}};
  const std::string failure =
      child.start(own_program(),
                  {"lockstep", "plugin", "check", file, "--hang-limit",
                   fmt::format("{}", options.hang_limit), "--from-leaf", fmt::format("{}", first)},
                  given);
  findings.writing = FileDescriptor();
  if (!failure.empty()) {
    result.steps.push_back({false, "cannot be examined: no process starts: " + failure});
    result.has_started = false;
    return std::nullopt;
  }
  Part part(result, first);
  read_lines(findings.reading.number(), part);
  return part.end(child.reap());
}

}  // namespace

Conformance check_object(const std::string& file, const PluginOptions& options) {
  Conformance result;
  std::optional<std::size_t> next = 0;
  while (next) next = run_part(file, options, *next, result);
  return result;
}

int examine_object(const std::string& file, const PluginOptions& options, std::size_t first) {
  keep_stdout_for_results();
  watch_this_thread(from_seconds(options.hang_limit));
  auto plugins = std::make_shared<PluginSet>();
  Diagnostics diagnostics;
  const bool is_good = plugins->load_file(file, diagnostics) && plugins->initialize(diagnostics);
  if (!is_good) {
    say_errors(diagnostics);
    say(kEnds, "");
    return kExitPluginRefused;
  }
  const auto types = plugins->types();
  std::vector<std::string_view> ids;
  for (const NodeType* type : types) ids.push_back(type->id);
  if (first == 0)
    say(ids.empty() ? kWrong : kGood, ids.empty() ? "has no leaves" : "has " + listed(ids));
  for (std::size_t i = first; i < types.size(); ++i) {
    const auto begin = [&](const std::string& what) {
      say(kBegins, fmt::format("{} '{}' {}", i, types[i]->id, what));
    };
    begin("");
    examine_leaf(*types[i], plugins,
                 {.note = [](bool it, const std::string& text) { say(it ? kGood : kWrong, text); },
                  .about_to = begin});
  }
  say(kBegins, fmt::format("{} {}", types.size(), kDeinit));
  plugins.reset();
  say(kGood, "is deinitialized");
  say(kEnds, "");
  return kExitSuccess;
}

}  // namespace lockstep::host
