// --leaves: what the leaves do is read from a file, and no plugin is asked. A script says it tick
// by tick; a leaf file says what they may do, and the seed of each run chooses.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cli/load/load_options.h"
#include "leaves/play/played_leaves.h"

namespace lockstep::host {

void add_leaves_option(CLI::App& app, std::string& file);

class GivenLeaves {
 public:
  // Reads the file. False, with a message, if it cannot be used.
  bool read(const std::string& path);
  bool empty() const { return path_.empty(); }
  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  // The rate and the number of ticks that the file asks for.
  std::optional<double> rate() const {
    if (file_ != nullptr) return file_->rate;
    return scripts_.rate;
  }
  std::optional<std::uint64_t> ticks() const { return scripts_.ticks; }
  const std::vector<ScriptCut>& cuts() const { return scripts_.cuts; }

  // All leaves of the definition are played from now on.
  void take_over(Definition& definition);
  // `tree` was made of the last definition. False, with messages, if the file is for
  // another one. The tree must stay where it is, and outlive its runs.
  bool give(const Tree& tree);

 private:
  bool read_scripts();
  // A mistake in the scripts.
  void tell(std::uint32_t line, std::uint32_t column, const std::string& message,
            const std::string& hint) const;

  std::string path_, text_;
  LeafScripts scripts_;
  std::unique_ptr<LeafFile> file_;  // null: scripts
  struct Given {
    PlayedLeaves played;
    LeafModels models;
  };
  std::deque<Given> given_;  // of each tree
  bool told_of_pace_ = false;
};

}  // namespace lockstep::host
