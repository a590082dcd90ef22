// Trees for BehaviorTree.CPP: which entries there are when they are loaded, and of which type.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "run/loading/plugins.h"
#include "tree/resolve.h"
#include "unit/document/told.h"

using namespace lockstep::host;

namespace {

using Lines = std::vector<std::string>;

constexpr Parameter kPorts[] = {
    {.name = "int", .type = ValueType::Int, .doc = "", .direction = Direction::InOut},
    {.name = "real", .type = ValueType::Double, .doc = "", .direction = Direction::InOut},
    {.name = "bool", .type = ValueType::Bool, .doc = "", .direction = Direction::InOut},
    {.name = "text", .type = ValueType::String, .doc = "", .direction = Direction::InOut},
    {.name = "list", .type = ValueType::DoubleList, .doc = "", .direction = Direction::InOut},
    {.name = "any",
     .type = ValueType::String,
     .doc = "",
     .direction = Direction::InOut,
     .is_generic = true}};
const NodeType kLeaf{.id = "Use",
                     .category = NodeCategory::Action,
                     .doc = "",
                     .arity = {0, 0},
                     .parameters = kPorts};
const NodeType kAll{.id = "All", .category = NodeCategory::Control, .doc = "", .arity = {.min = 1}};

struct Resolved {
  Diagnostics diagnostics;
  std::unique_ptr<Project> project;
  std::optional<Definition> definition;
};

Resolved resolved(const std::string& main, const std::string& sub) {
  Resolved it;
  it.project = load_project_text("f",
                                 "<root BTCPP_format='4' main_tree_to_execute='Main'>"
                                 "<BehaviorTree ID='Sub'><All>" +
                                     sub + "</All></BehaviorTree>\n<BehaviorTree ID='Main'><All>" +
                                     main + "</All></BehaviorTree></root>",
                                 Arguments(), it.diagnostics);
  REQUIRE(it.project);
  Catalog catalog = make_catalog({}, btcpp::kRules);
  catalog.add(&kLeaf);
  catalog.add(&kAll);
  it.definition = resolve(*it.project, catalog, {}, it.diagnostics);
  return it;
}

// "name: type = value", of those that there are from the beginning.
Lines entries(const std::string& main, const std::string& sub = "<Use/>") {
  const Resolved it = resolved(main, sub);
  if (!it.definition) return {it.diagnostics.all().front().message};
  Lines lines;
  for (const BlackboardEntry& entry : it.definition->entries) {
    std::string line = entry.name + ": ";
    line += !entry.is_present             ? "absent"
            : entry.typing == Typing::Any ? "any"
                                          : std::string(to_string(entry.type));
    if (!std::holds_alternative<NoValue>(entry.initial)) line += " = " + to_text(entry.initial);
    lines.push_back(line);
  }
  return lines;
}

struct EntriesRow {
  std::string law, main, sub;
  Lines entries;
};

}  // namespace

TEST_CASE("the first port with a type decides the type of an entry") {
  const EntriesRow rows[] = {
      {"a port declares", "<Use int='{a}'/>", "", {"a: int"}},
      {"again", "<Use int='{a}'/><Use int='{a}'/>", "", {"a: int"}},
      {"another type",
       "<Use int='{a}'/><Use real='{a}'/>",
       "",
       {"'{a}' is a double for 'real', but an int elsewhere"}},
      {"a text is read by all", "<Use text='{a}'/><Use int='{a}'/>", "", {"a: string"}},
      {"a text port reads no number",
       "<Use int='{a}'/><Use text='{a}'/>",
       "",
       {"'{a}' is a string for 'text', but an int elsewhere"}},
      {"a generic one gives none",
       "<Use any='{a}'/><Use int='{a}'/><Use bool='{a}'/>",
       "",
       {"a: any"}},
      {"and takes any", "<Use int='{a}'/><Use any='{a}'/>", "", {"a: int"}},
      {"the name of the port", "<Use int='{=}' real='='/>", "", {"int: int", "real: double"}},
      {"keys may be anything",
       "<Use int='{ x }' real='{{x}}' bool='{a.b}'/>",
       "",
       {" x : int", "{x}: double", "a.b: bool"}},
      {"literals are none", "<Use text='{}' list='1;2'/>", "", {}},
      {"a script declares nothing", "<Use _skipIf='a == 1'/>", "", {"a: absent"}},
      {"whatever comes first", "<Use _post='a := 1'/><Use int='{a}'/>", "", {"a: int"}},
      {"blanks around", "<Use text=' {a} '/>", "", {"a: string"}},
  };
  for (const EntriesRow& row : rows) {
    INFO(row.law);
    CHECK(entries(row.main) == row.entries);
  }
}

TEST_CASE("a SubTree has a board, and its attributes remap it or give start values") {
  const EntriesRow rows[] = {
      {"a board",
       "<SubTree ID='Sub'/><Use int='{a}'/>",
       "<Use real='{a}'/>",
       {"Sub/a: double", "a: int"}},
      {"remapped", "<SubTree ID='Sub' a='{o}'/>", "<Use real='{a}'/>", {"o: double"}},
      {"the same key", "<SubTree ID='Sub' a='{=}'/>", "<Use real='{a}'/>", {"a: double"}},
      {"conflict over a remapping",
       "<Use int='{o}'/><SubTree ID='Sub' a='{o}'/>",
       "<Use real='{a}'/>",
       {"'{a}' is a double for 'real', but an int elsewhere"}},
      {"autoremap",
       "<SubTree ID='Sub' _autoremap='1'/>",
       "<Use real='{a}' int='{_b}'/>",
       {"Sub/_b: int", "a: double"}},
      {"but not of a literal",
       "<SubTree ID='Sub' _autoremap='1' a='2'/>",
       "<Use int='{a}'/>",
       {"Sub/a: int = 2"}},
      {"the main board",
       "<SubTree ID='Sub'/>",
       "<Use real='{@a}' _while='@b'/>",
       {"b: absent", "a: double"}},
      {"remapped to the main board",
       "<SubTree ID='Sub' a='{@k}'/>",
       "<Use real='{a}'/>",
       {"k: double"}},
      {"a whole literal", "<SubTree ID='Sub' a='-5'/>", "<Use int='{a}'/>", {"Sub/a: int = -5"}},
      {"as the port needs it",
       "<SubTree ID='Sub' a='5'/>",
       "<Use real='{a}'/><Use any='{a}'/>",
       {"Sub/a: double = 5"}},
      {"a bool", "<SubTree ID='Sub' a='1'/>", "<Use bool='{a}'/>", {"Sub/a: bool = true"}},
      {"a text", "<SubTree ID='Sub' a='5'/>", "<Use text='{a}'/>", {"Sub/a: string = 5"}},
      {"for nobody but a script",
       "<SubTree ID='Sub' a='1e3'/>",
       "<Use _post='a'/>",
       {"Sub/a: double = 1000"}},
      {"words stay texts",
       "<SubTree ID='Sub' a='true' b=' 5' c='+5' d=''/>",
       "<Use bool='{a}' int='{b}' real='{c}' any='{d}'/>",
       {"Sub/a: string = true", "Sub/b: string =  5", "Sub/c: string = +5", "Sub/d: string = "}},
      {"not what the port needs",
       "<SubTree ID='Sub' a='1.5'/>",
       "<Use int='{a}'/>",
       {"the start value '1.5' of 'Sub/a' is not a whole number, which 'int' must be"}},
      {"two ports",
       "<SubTree ID='Sub' a='5'/>",
       "<Use int='{a}'/><Use real='{a}'/>",
       {"'{a}' is a double for 'real', but an int elsewhere"}},
  };
  for (const EntriesRow& row : rows) {
    INFO(row.law);
    Lines sorted = entries(row.main, row.sub);
    Lines expected = row.entries;
    std::sort(sorted.begin(), sorted.end());
    std::sort(expected.begin(), expected.end());
    CHECK(sorted == expected);
  }
}

TEST_CASE(
    "the scripts of a node are bound to the entries of its board, those of a SubTree outside") {
  const Resolved it =
      resolved("<SubTree ID='Sub' _onSuccess='a := 1; b += a' _while='a'/>", "<Use _skipIf='a'/>");
  REQUIRE(it.definition);
  const Definition& definition = *it.definition;
  const auto names_of = [&](std::uint32_t node, Hook hook) {
    const auto script = definition.hooks.at(definition.nodes[node].hooks)[std::size_t(hook)];
    REQUIRE(script != Port::kNone);
    Lines names;
    for (const auto entry : definition.scripts[script].entries) {
      names.push_back(definition.entries[entry].name);
    }
    return names;
  };
  CHECK(names_of(1, Hook::OnSuccess) == Lines{"a", "b"});
  CHECK(names_of(1, Hook::While) == Lines{"a"});
  CHECK(names_of(3, Hook::SkipIf) == Lines{"Sub/a"});
  CHECK(definition.nodes[0].hooks == Port::kNone);
}

TEST_CASE("a script that does not parse is an error at its column") {
  const Resolved it = resolved("<Use _skipIf='a == '/>\n<Use _post=''/>", "<Use/>");
  CHECK_FALSE(it.definition);
  const Lines lines = told(it.diagnostics);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == "f:2:49: a value is missing at the end");
  CHECK(lines[1] == "f:3:13: the script is empty");
}
