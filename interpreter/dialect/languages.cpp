// The list of languages, and the rules of our own.
#include "base/core/language.h"
#include "dialect/btcpp/rules.h"
#include "engine/nodes/kinds.h"
#include "tree/check/check_trees.h"
#include "tree/language_reader.h"

namespace lockstep::host {
namespace {

CheckedTrees read(const Project& project, const Catalog& catalog, const Models&,
                  Diagnostics& diagnostics) {
  return check_trees(project, catalog, diagnostics);
}

constexpr LanguageReader kReader{.read = read};

}  // namespace

constinit const LanguageRules kLockstepRules{
    .name = "lockstep",
    .title = "lockstep's language",
    .root_attribute = "lockstep",
    .root_may_lack_it = false,
    .hooks = {"failure_if", "success_if", "skip_if", "while", "on_success", "on_failure", "on_end",
              "on_halt"},
    .on_resume = "on_resume",
    .commit = "commit",
    .kinds = kBuiltInKinds,
    .reader = &kReader,
    .lenient_xml = false,
    .lenient_includes = false,
    .unknown_arguments_are_text = false,
    .may_lack_nodes = false,
    .checks_unused_trees = false,
    .strict_types = true,
    .marked_keys = false,
    .strict_scripts = true,
    .conditions_may_run = false,
    .may_tick_again = false};

// The name by which the linker takes this file: interpreter/CMakeLists.txt.
extern "C" const char lockstep_languages;
extern "C" const char lockstep_languages = 0;

std::span<const LanguageRules* const> languages() {
  static constexpr const LanguageRules* kLanguages[] = {
      &kLockstepRules,
      &btcpp::kRules,
  };
  return kLanguages;
}

}  // namespace lockstep::host
