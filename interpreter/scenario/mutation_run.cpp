#include "scenario/mutation_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "language/document/document.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

enum class Outcome : std::uint8_t { Noticed, Survived, Unusable };

Outcome play_mutation(const Mutation& mutation, const std::string& tree,
                      std::span<const ScenarioFile* const> files,
                      const std::function<bool(const ScenarioFile&, const Scenario&)>& is_chosen,
                      const TestOptions& options) {
  TestOptions changed = options;
  changed.out.clear();
  changed.covers = changed.updates = false;
  changed.changed_tree = tree;
  changed.changed_text = mutation.text;
  TestRun run(
      {files.begin(), files.end()},
      [&](const ScenarioFile& file, const Scenario& it) {
        return it.tree == tree && !it.is_verified && is_chosen(file, it);
      },
      std::move(changed));
  std::size_t played = 0, noticed = 0;
  run.run([&](const ScenarioReport& report) {
    // A scenario that names what is gone says nothing about the change.
    if (report.errors.empty()) ++played;
    if (!report.surprises.empty()) ++noticed;
  });
  if (noticed > 0) return Outcome::Noticed;
  return played == 0 ? Outcome::Unusable : Outcome::Survived;
}

}  // namespace

std::vector<MutatedTree> run_mutations(
    std::span<const ScenarioFile* const> files,
    const std::function<bool(const ScenarioFile&, const Scenario&)>& is_chosen,
    const TestOptions& options) {
  std::vector<MutatedTree> trees;
  for (const ScenarioFile* file : files) {
    for (const Scenario& it : file->scenarios) {
      if (!is_chosen(*file, it) || it.is_verified) continue;
      if (std::ranges::find(trees, it.tree, &MutatedTree::file) == trees.end()) {
        trees.push_back({.file = it.tree});
      }
    }
  }
  for (MutatedTree& tree : trees) {
    const auto text = read_file(tree.file, Document::kMaxBytes);
    if (!text) continue;
    for (Mutation& mutation : mutations_of(tree.file, *text)) {
      if (options.stop_signal && options.stop_signal() != 0) return trees;
      switch (play_mutation(mutation, tree.file, files, is_chosen, options)) {
        case Outcome::Noticed:
          ++tree.noticed;
          break;
        case Outcome::Unusable:
          ++tree.unusable;
          break;
        case Outcome::Survived:
          tree.survivors.push_back(std::move(mutation));
      }
    }
  }
  return trees;
}

std::string to_text(std::span<const MutatedTree> trees) {
  std::string text;
  for (const MutatedTree& tree : trees) {
    text += fmt::format("changes of {}: {} of {} noticed\n", printable(tree.file), tree.noticed,
                        tree.all());
    for (const Mutation& it : tree.survivors) {
      text += fmt::format("  no scenario notices: {}: {}\n", it.place, printable(it.what));
    }
  }
  return text;
}

double percent(std::span<const MutatedTree> trees) {
  std::size_t all = 0, noticed = 0;
  for (const MutatedTree& it : trees) {
    all += it.all();
    noticed += it.noticed;
  }
  return all == 0 ? 100 : 100 * static_cast<double>(noticed) / static_cast<double>(all);
}

}  // namespace lockstep::host
