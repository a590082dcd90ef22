// The commands with their options, as CLI11 knows them: what the command line is parsed with, and
// what help, completion and manual pages are made from.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace lockstep::host {

// The options take longer to define than many a command takes, so those of commands that are not
// named can be left out, and behind the name of a command the other commands, too. But a hint may
// be about any of them.
class Program {
 public:
  enum class Options { OfNamedCommands, OfAllCommands };

  Program(const std::vector<std::string>& words, Options options);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  CLI::App& app() { return *app_; }
  // Runs the command that was parsed.
  int run() const;

 private:
  std::unique_ptr<CLI::App> app_;
  bool is_verbose_ = false;
  std::vector<std::pair<const CLI::App*, std::function<int()>>> actions_;
};

}  // namespace lockstep::host
