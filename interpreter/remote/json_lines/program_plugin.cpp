#include "remote/json_lines/program_plugin.h"

#include <fmt/format.h>

#include <utility>

#include "remote/json_lines/described_element.h"
#include "remote/json_lines/leaves_file.h"
#include "remote/json_lines/program_run.h"

namespace lockstep::host {

ProgramPlugin::ProgramPlugin(std::string path, IsolationOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

Result<std::unique_ptr<ProgramPlugin>> ProgramPlugin::open(const std::string& path,
                                                           const std::string& name, Hold hold,
                                                           const IsolationOptions& options) {
  std::unique_ptr<ProgramPlugin> plugin(new ProgramPlugin(path, options));
  auto line = plugin->first_line();
  if (!line) return tl::unexpected(std::move(line.error()));
  auto hello = Hello::read(std::move(*line), name, hold);
  if (!hello) return tl::unexpected(std::move(hello.error()));
  plugin->hello_ = std::move(*hello);
  return plugin;
}

Result<std::string> ProgramPlugin::first_line() {
  auto written = read_leaves_file(path_);
  if (!options_.run_programs) {
    is_file_older_ = is_older_than_program(path_);
    if (written) return *std::move(written);
    return problem("is a program, which this command does not run: its leaves are not known",
                   fmt::format("give --run-programs, or let 'lockstep plugin check --save' write "
                               "them to '{}'",
                               leaves_file_of(path_)));
  }
  const Lock lock(mutex_);
  first_ = std::make_unique<Conversation>(options_);
  auto line = first_->start(path_);
  is_file_stale_ = line && written && *line != *written;
  return line;
}

// A process that waits for its run answers, else one that was started for it and waits then.
tl::expected<const lockstep_leaf_type*, ElementRefusal> ProgramPlugin::describe(
    std::string_view id, std::span<const FixedText> fixed) {
  const auto refused = [&](std::string_view why, const char* hint) {
    return tl::unexpected(ElementRefusal{{}, {fmt::format("'{}' {}", id, why), hint}});
  };
  if (!options_.run_programs) {
    return refused("has ports that its program knows, which this command does not run",
                   "give --run-programs");
  }
  std::string failure;
  auto conversation = acquire(failure);
  if (conversation == nullptr) return refused("cannot be described: " + failure, "");
  const Lock lock(mutex_);
  auto described = describe_element(*conversation, *hello_, id, fixed, described_.emplace_back());
  if (first_ == nullptr && !conversation->is_gone()) first_ = std::move(conversation);
  return described;
}

std::unique_ptr<RemoteRun> ProgramPlugin::begin_run(const lockstep_caller& caller) {
  return begin_program_run(*this, caller);
}

std::unique_ptr<Conversation> ProgramPlugin::acquire(std::string& failure) {
  {
    const Lock lock(mutex_);
    if (first_ != nullptr) return std::move(first_);
  }
  auto conversation = std::make_unique<Conversation>(options_);
  const auto line = conversation->start(path_);
  if (!line) {
    failure = fmt::format("its program {}", line.error().message);
  } else if (*line != hello_->line()) {
    failure =
        "its program says now that it has other leaves than when it was loaded: let 'lockstep "
        "plugin check --save' write them down";
  } else {
    return conversation;
  }
  return nullptr;
}

}  // namespace lockstep::host
