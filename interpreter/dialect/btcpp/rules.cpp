#include "dialect/btcpp/rules.h"

#include "dialect/btcpp/hints.h"
#include "dialect/btcpp/nodes/kinds.h"
#include "dialect/btcpp/read_trees.h"
#include "dialect/btcpp/version_3.h"
#include "tree/language_reader.h"

namespace lockstep::host::btcpp {
namespace {

constexpr LanguageReader kReader{
    .read = read_trees, .is_old_name = is_old_name, .old_names = old_names, .hints = &kHints};

}  // namespace

constinit const LanguageRules kRules{.name = "btcpp4",
                                     .title = "BehaviorTree.CPP",
                                     .root_attribute = "BTCPP_format",
                                     .root_may_lack_it = true,  // before version 4
                                     .hooks = {"_failureIf", "_successIf", "_skipIf", "_while",
                                               "_onSuccess", "_onFailure", "_post", "_onHalted"},
                                     .on_resume = "_onResume",
                                     .commit = "_commit",
                                     .kinds = kKinds,
                                     .reader = &kReader,
                                     .lenient_xml = true,
                                     .lenient_includes = true,
                                     .unknown_arguments_are_text = true,
                                     .may_lack_nodes = true,
                                     .checks_unused_trees = true,
                                     .strict_types = false,
                                     .marked_keys = true,
                                     .strict_scripts = false,
                                     .conditions_may_run = true,
                                     .may_tick_again = true};

}  // namespace lockstep::host::btcpp
