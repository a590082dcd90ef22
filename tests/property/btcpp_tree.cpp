#include "property/btcpp_tree.h"
#include "dialect/btcpp/rules.h"

#include <catch2/catch.hpp>

#include "engine/compile.h"
#include "run/loading/plugins.h"
#include "support/scripted_leaf.h"
#include "tree/resolve.h"

namespace lockstep::host::test::law {
namespace {

const std::vector<Parameter> kOutput{
    {.name = "out", .type = ValueType::Int, .doc = "", .direction = Direction::Output}};
const NodeType kAct{.id = "Act",
                    .category = NodeCategory::Action,
                    .doc = "",
                    .arity = {0, 0},
                    .parameters = kOutput,
                    .can_run = true,
                    .leaf = &kScriptedAction};
const NodeType kCond{.id = "Cond",
                     .category = NodeCategory::Condition,
                     .doc = "",
                     .arity = {0, 0},
                     .parameters = kOutput,
                     .leaf = &kScriptedCondition};

}  // namespace

Tree tree_of(const Document& document) {
  const std::string xml = to_xml(document);
  Catalog catalog = make_catalog({}, btcpp::kRules);
  catalog.add(&kAct);
  catalog.add(&kCond);
  Diagnostics diagnostics;
  const auto project = load_project_text("f", xml, {}, diagnostics);
  const auto definition = resolve(*project, catalog, {}, diagnostics);
  for (const Diagnostic& it : diagnostics.all()) {
    if (it.severity == Severity::Error) FAIL(render(it, false) << xml);
  }
  return compile(*definition);
}

}  // namespace lockstep::host::test::law
