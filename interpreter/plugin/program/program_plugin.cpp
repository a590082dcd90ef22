#include "plugin/program/program_plugin.h"

#include <fmt/format.h>

#include <utility>

#include "plugin/program/program_run.h"

namespace lockstep {

ProgramPlugin::ProgramPlugin(std::string path, IsolationOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

Result<std::unique_ptr<ProgramPlugin>> ProgramPlugin::open(const std::string& path,
                                                           const std::string& name, Hold hold,
                                                           const IsolationOptions& options) {
  std::unique_ptr<ProgramPlugin> plugin(new ProgramPlugin(path, options));
  plugin->first_ = std::make_unique<Conversation>(plugin->options_);
  auto line = plugin->first_->start(path);
  if (!line) return tl::unexpected(std::move(line.error()));
  auto hello =
      Hello::read(std::move(*line), name, hold, program_functions(), program_leaf_functions());
  if (!hello) return tl::unexpected(std::move(hello.error()));
  plugin->hello_ = std::move(*hello);
  return plugin;
}

std::unique_ptr<Conversation> ProgramPlugin::acquire(std::string& failure) {
  {
    const std::lock_guard lock(mutex_);
    if (first_ != nullptr) return std::move(first_);
  }
  auto conversation = std::make_unique<Conversation>(options_);
  const auto line = conversation->start(path_);
  if (!line) {
    failure = fmt::format("its program {}", line.error().message);
  } else if (*line != hello_->line()) {
    failure = "its program says now that it has other leaves than when it was loaded";
  } else {
    return conversation;
  }
  return nullptr;
}

}  // namespace lockstep
