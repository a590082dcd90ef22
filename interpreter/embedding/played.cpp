// Leaves that play scripts in place of those of plugins, and properties of a run: what tests of
// trees need.
#include <fmt/format.h>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "embedding/run_handle.h"
#include "leaves/models.h"

namespace lockstep::host::embedding {
namespace {

// The words of one leaf, or nothing after fail().
std::optional<std::vector<LeafWord>> words_of(std::string_view text) {
  std::vector<LeafWord> words;
  for (std::size_t at = text.find_first_not_of(" \t\n"); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t\n", at), text.size());
    const std::string_view it = text.substr(at, end - at);
    auto word = parse_leaf_word(it);
    if (!word) {
      fail(fmt::format(
          "'{}' is not a word of a leaf: there are R0.5, S, F, K, X, ~0.5 and S[port=value]",
          brief(it)));
      return std::nullopt;
    }
    words.push_back(std::move(*word));
    at = text.find_first_not_of(" \t\n", end);
  }
  if (words.empty()) fail("a leaf needs at least one word");
  return words.empty() ? std::nullopt : std::optional(std::move(words));
}

bool play(lockstep_project& project, std::string_view path, std::string_view text,
          bool in_each_activation) {
  if (project.played == nullptr) {
    return fail("the leaves are those of plugins: lockstep_project_play_leaves before loading");
  }
  if (project.program == nullptr) return fail("the project has not been loaded");
  auto words = words_of(text);
  if (!words) return false;
  const Tree& tree = project.program->runnable.tree;
  LeafScripts scripts = project.scripts;
  std::vector<std::string> paths;
  bool is_found = false;
  for (const LeafNode& leaf : tree.leaves) {
    const std::string& it = paths.emplace_back(tree.path(leaf.node));
    if (!matches(path, it)) continue;
    is_found = true;
    scripts.leaves[it] = *words;
    in_each_activation ? void(scripts.restarting.insert(it)) : void(scripts.restarting.erase(it));
  }
  if (!is_found) {
    const std::vector<std::string_view> known(paths.begin(), paths.end());
    return fail(fmt::format("no leaf has the path '{}': {}", brief(path),
                            suggest_path(path, known, "its leaves")));
  }
  if (const auto wrong = PlayedLeaves::check(scripts, tree)) {
    return fail(wrong->hint.empty() ? wrong->message
                                    : fmt::format("{}: {}", wrong->message, wrong->hint));
  }
  project.scripts = scripts;
  project.played->set_scripts(std::move(scripts));
  return true;
}

bool may_have_properties(lockstep_run& run) {
  if (!is_own(run)) return false;
  return (!run.is_busy && run.is_new()) ||
         fail("the run has been ticked already: properties are checked from its first tick on");
}

}  // namespace
}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

bool lockstep_project_play_leaves(lockstep_project* project) {
  return guarded([&] {
    if (project == nullptr) return fail("an argument is NULL");
    if (project->load_tried) return fail("the project has been loaded already");
    project->options.unknown = MissingNodes::AreMocked;
    project->played = std::make_shared<PlayedLeaves>();
    return true;
  });
}

bool lockstep_project_play(lockstep_project* project, const char* path, const char* words,
                           bool in_each_activation) {
  return guarded([&] {
    if (project == nullptr) return fail("an argument is NULL");
    return is_text("the path", path) && is_text("the words", words) &&
           play(*project, path, words, in_each_activation);
  });
}

bool lockstep_run_check(lockstep_run* run, const char* property) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    if (!may_have_properties(*run)) return false;
    const bool was_empty = run->properties.empty();
    const std::size_t told = run->properties.fresh().size();
    if (property == nullptr) {
      run->properties.add(run->program->runnable.properties);
    } else {
      if (!is_text("the property", property)) return false;
      if (const auto wrong = run->properties.add(property)) {
        return fail(wrong->hint.empty() ? wrong->message
                                        : fmt::format("{}; {}", wrong->message, wrong->hint));
      }
    }
    if (was_empty && !run->properties.empty()) run->watchers.watch(run->properties);
    run->tell_fresh_properties(told);
    return true;
  });
}

const char* lockstep_run_violation(lockstep_run* run, uint32_t index) {
  return shielded([&]() -> const char* {
    if (run == nullptr || index >= run->properties.violations().size()) return nullptr;
    return run->properties.violations()[index].c_str();
  });
}
