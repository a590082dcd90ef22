#include "leaves/remote/json_lines/program_plugin.h"

#include <fmt/format.h>

#include <utility>

#include "leaves/remote/json_lines/described_element.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "leaves/remote/json_lines/program_run.h"

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
    return problem(
        "is a program, which this command does not run: its leaves are not known",
        fmt::format("give --run-programs, or let 'lockstep plugin check --list --save {}' "
                    "write them to '{}'",
                    path_, leaves_file_of(path_)));
  }
  const Lock lock(mutex_);
  first_ = std::make_unique<Conversation>(options_);
  auto line = first_->start(path_);
  is_file_stale_ = line && written && *line != *written;
  return line;
}

tl::expected<const lockstep_leaf_type*, ElementRefusal> ProgramPlugin::describe(
    std::string_view id, std::span<const FixedText> fixed) {
  const lockstep_leaf_type& base = *hello_->type_named(id);
  const std::string request = describe_request(base, fixed);
  auto answer = options_.run_programs ? ask(request) : read_answer(request);
  if (!answer) return tl::unexpected(undescribed(id, answer.error()));
  const Lock lock(mutex_);
  try {
    auto described = read_described(*answer, base, described_.emplace_back());
    if (described) descriptions_ += fmt::format("{}\n{}\n", request, *answer);
    return described;
  } catch (const JsonError& error) {
    return tl::unexpected(
        undescribed(id, {fmt::format("answers describe wrongly: {}", error.what()),
                         "`lockstep docs programs` has the answers to describe"}));
  }
}

// A process that waits for its run, else one that is started for this and waits then.
Result<std::string> ProgramPlugin::ask(std::string_view request) {
  std::string failure;
  auto conversation = acquire(failure);
  if (conversation == nullptr) return problem(failure);
  auto answer = ask_to_describe(*conversation, request);
  const Lock lock(mutex_);
  if (answer && first_ == nullptr) first_ = std::move(conversation);
  return answer;
}

Result<std::string> ProgramPlugin::read_answer(std::string_view request) const {
  if (auto answer = read_description(path_, request)) return *std::move(answer);
  return problem(
      "is not run by this command, and its file does not have this element",
      fmt::format(
          "give --run-programs, or let 'lockstep plugin check --list --save --tree TREE {}' "
          "write it to '{}'",
          path_, leaves_file_of(path_)));
}

std::string ProgramPlugin::descriptions() {
  const Lock lock(mutex_);
  return descriptions_;
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
    failure = line.error().message;
  } else if (*line != hello_->line()) {
    failure =
        "now lists other leaves than when it was loaded: write the file again with 'lockstep "
        "plugin check --save'";
  } else {
    return conversation;
  }
  return nullptr;
}

}  // namespace lockstep::host
