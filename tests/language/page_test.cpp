// The pages of the language themselves: their examples load, their traces are what a run does,
// their tables are complete, their links lead somewhere.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "base/core/wording.h"
#include "dialect/btcpp/hints.h"
#include "dialect/btcpp/pairs.h"
#include "dialect/btcpp/rules.h"
#include "dialect/btcpp/version_3.h"
#include "dialect/btcpp/words.h"
#include "engine/synchronized.h"
#include "language/document/arguments.h"
#include "language/document/well_formed.h"
#include "language/pipeline.h"
#include "run/run.h"
#include "support/generated_file.h"
#include "support/paths.h"
#include "tree/check/models.h"
#include "tree/definition.h"

namespace lockstep::host::test {
namespace {

constexpr const char* kReference = "docs/nodes-and-attributes.md";
constexpr const char* kPages[] = {"docs/language.md", kReference, "docs/deadlocks.md"};

// All pages, one behind the other.
std::string read_pages() {
  std::string text;
  for (const char* page : kPages) text += project_file(page);
  return text;
}

struct Example {
  std::string xml;
  std::string told;  // the error or warning that it must produce, or ""
};

// "<!-- error: unknown node -->", or "warning: ", is before an example that is told "unknown node".
std::string told_by(std::string_view line) {
  for (const std::string_view open : {"<!-- error: ", "<!-- warning: "}) {
    if (!line.starts_with(open)) continue;
    return std::string(line.substr(open.size(), line.rfind(" -->") - open.size()));
  }
  return {};
}

// The blocks ```xml, with what a comment in the line before says of them.
std::vector<Example> examples(const std::string& page) {
  std::vector<Example> examples;
  std::istringstream lines(page);
  std::string previous;
  bool inside = false;
  for (std::string line; std::getline(lines, line); previous = line) {
    if (line == "```xml") {
      examples.push_back({"", told_by(previous)});
      inside = true;
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      examples.back().xml += line + "\n";
    }
  }
  return examples;
}

Example example_of(std::string_view tree) {
  for (Example& example : examples(read_pages())) {
    if (example.xml.find(fmt::format("ID=\"{}\"", tree)) != std::string::npos) return example;
  }
  FAIL("no example " << tree);
  return {};
}

std::string word(Ticker& ticker, NodeIndex child, Status before) {
  if (is_complete(before)) return "done";
  return ticker.ticked(child) ? "ticked" : "held";
}

// The rows of a worked trace. `limit` is what the children with least progress `m` wait at.
template <class Limit>
std::string trace(std::string_view tree, Limit limit) {
  const Pipeline pipeline(example_of(tree).xml);
  REQUIRE(pipeline.loaded());
  Run run(pipeline.tree(), {});
  Ticker& ticker = run.ticker();
  constexpr NodeIndex kArm = 1, kBase = 2;
  std::string rows;
  Status status = Status::Running;
  for (int tick = 1; status == Status::Running; ++tick) {
    const Status arm = ticker.status(kArm), base = ticker.status(kBase);
    status = run.tick(tick * run.period());
    const auto before = child_progress(ticker, 0);
    rows += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {} | {} |\n", tick, before[0], before[1],
                        limit(std::min(before[0], before[1])), word(ticker, kArm, arm),
                        word(ticker, kBase, base));
  }
  return rows;
}

TEST_CASE("the examples of the pages load, and the wrong ones are reported as they say") {
  const std::string page = read_pages();
  const auto all = examples(page);
  CHECK(all.size() > 10);
  for (const Example& example : all) {
    INFO(example.xml);
    Pipeline pipeline(example.xml);
    pipeline.advise();
    if (example.told.empty()) {
      CHECK(pipeline.told().empty());
      continue;
    }
    REQUIRE(pipeline.diagnostics().all().size() == 1);
    CHECK(pipeline.diagnostics().all().front().message == example.told);
    CHECK(page.find("`" + example.told + "`") != std::string::npos);
  }
}

TEST_CASE("the worked traces of the page are what a run does") {
  const std::string page = read_pages();
  const std::string absolute = trace("A1", [](double m) { return m < 0.5 - 1e-9 ? 0.5 : 1.0; });
  CHECK(std::ranges::count(absolute, '\n') == 10);
  CHECK(page.find("|\n" + absolute + "\n") != std::string::npos);
  const std::string relative = trace("R1", [](double m) { return m + 0.2; });
  CHECK(std::ranges::count(relative, '\n') == 10);
  CHECK(page.find("|\n" + relative + "\n") != std::string::npos);
}

TEST_CASE("the trace of the resources on the page is what a run does") {
  const Pipeline pipeline(example_of("Dinner").xml);
  REQUIRE(pipeline.loaded());
  Run run(pipeline.tree(), {});
  std::string rows;
  Status status = Status::Running;
  for (int tick = 1; status == Status::Running; ++tick) {
    std::vector<Status> before;
    for (const LeafNode& leaf : pipeline.tree().leaves) {
      before.push_back(run.ticker().status(leaf.node));
    }
    status = run.tick(tick * run.period());
    rows += fmt::format("| {} |", tick);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const NodeIndex leaf = pipeline.tree().leaves[i].node;
      const std::string now = word(run.ticker(), leaf, before[i]);
      rows += " " + (now == "held" ? "waits" : now) + " |";
    }
    rows += "\n";
  }
  CHECK(std::ranges::count(rows, '\n') == 6);
  CHECK(read_pages().find("|\n" + rows + "\n") != std::string::npos);
}

TEST_CASE("the reference names every built-in node and parameter, and every limit") {
  const std::string page = project_file(kReference);
  const auto names = [&](std::string_view text) {
    INFO(text);
    CHECK(page.find(text) != std::string::npos);
  };
  for (const NodeKind* kind : built_in_kinds()) {
    names(fmt::format("`{}`", kind->type.id));
    for (const Parameter& it : kind->type.parameters) names(fmt::format("`{}", it.name));
  }
  names(fmt::format("| {} MiB |", Document::kMaxBytes >> 20u));
  STATIC_REQUIRE(kMaxElementDepth == 1'024);
  names("`root` included | 1,024 |");
  names(fmt::format("| {} MiB, all together {} MiB |", kMaxValueMiB, kMaxExpandedMiB));
  STATIC_REQUIRE(kMaxNodes == 4'000'000);
  names("| 4,000,000 |");
  STATIC_REQUIRE(kMaxDepth == 1'000);
  names("| 1,000 |");
}

std::string in_code(std::string_view text) {
  return fmt::format("`{}`", text);
}

// The names there for which there is a hint, also those before version 4.
std::vector<std::string> hinted_names(const btcpp::NodePair& pair) {
  std::vector<std::string> names;
  if (btcpp::needs_hint(pair, pair.theirs)) names.push_back(in_code(pair.theirs));
  for (const auto& [before, since] : btcpp::renamed_nodes()) {
    if (since == pair.theirs) names.push_back(in_code(before));
  }
  return names;
}

std::string foreign_row(const btcpp::NodePair& pair, const std::vector<std::string>& names) {
  const auto note = [](btcpp::Conversions conversion) -> std::string_view {
    if (conversion == btcpp::Conversions::Milliseconds) return " (not milliseconds)";
    return conversion == btcpp::Conversions::Rounds ? " (left out = indefinitely)" : "";
  };
  std::vector<std::string> theirs, ours;
  for (const auto& attributes : {pair.attributes, pair.words}) {
    for (const btcpp::AttributePair& it : attributes) {
      theirs.push_back(in_code(it.theirs));
      if (!it.ours.empty()) ours.push_back(in_code(it.ours).append(note(it.conversion)));
    }
  }
  const std::regex tag("((?:<[^>]+>)+)");
  return fmt::format("| {}{}{} | {}{}{} | {} |\n", joined(names, ", "), theirs.empty() ? "" : ": ",
                     joined(theirs, ", "),
                     pair.ours.empty() ? "none" : in_code(btcpp::instead_of(pair)),
                     ours.empty() ? "" : ": ", joined(ours, ", "),
                     std::regex_replace(std::string(pair.remark), tag, "`$1`"));
}

// The table of the reference, from that of the hints.
std::string foreign_table() {
  const auto same = [](const btcpp::NodePair& a, const btcpp::NodePair& b) {
    return a.ours == b.ours && a.remark == b.remark && a.in_ours.value == b.in_ours.value &&
           a.words.data() == b.words.data() && a.attributes.empty() && b.attributes.empty();
  };
  std::string table = "| There | Here | |\n|---|---|---|\n";
  for (const auto& pairs : {btcpp::node_pairs(), btcpp::similar_nodes()}) {
    for (std::size_t i = 0; i < pairs.size();) {
      const btcpp::NodePair& pair = pairs[i];
      std::vector<std::string> names = hinted_names(pair);
      for (++i; i < pairs.size() && !names.empty() && same(pair, pairs[i]); ++i) {
        std::ranges::move(hinted_names(pairs[i]), std::back_inserter(names));
      }
      if (!names.empty()) table += foreign_row(pair, names);
    }
  }
  std::vector<std::string> theirs, ours, marks;
  for (const std::string_view it : btcpp::kRules.hooks) theirs.push_back(in_code(it));
  for (const std::string_view it : kLockstepRules.hooks) ours.push_back(in_code(it));
  for (const std::string_view it : btcpp::kMarks) marks.push_back(in_code(it));
  return table +
         fmt::format("| any node: {} | any node: {} |  |\n", joined(theirs, ", "),
                     joined(ours, ", ")) +
         fmt::format("| any node: {} | none | a mark of an editor |\n", joined(marks, ", "));
}

TEST_CASE("what is generated: what to write instead of the nodes of other libraries") {
  const std::string page = project_file(kReference);
  constexpr std::string_view kHead = "\n| There | Here | |\n";
  const auto at = page.find(kHead);
  REQUIRE(at != std::string::npos);
  check_generated(kReference, page.substr(0, at + 1) + foreign_table());
}

TEST_CASE("no node and no parameter of ours is taken for one of another library") {
  for (const NodeKind* kind : built_in_kinds()) {
    for (const auto& pairs : {btcpp::node_pairs(), btcpp::similar_nodes()}) {
      const auto pair = std::ranges::find(pairs, kind->type.id, &btcpp::NodePair::theirs);
      if (pair == pairs.end()) continue;
      INFO(pair->theirs);
      CHECK(pair->ours == pair->theirs);
      for (const btcpp::AttributePair& attribute : pair->attributes) {
        const auto& parameters = kind->type.parameters;
        const bool is_ours =
            std::ranges::find(parameters, attribute.theirs, &Parameter::name) != parameters.end();
        CHECK((!is_ours || attribute.ours == attribute.theirs));
      }
    }
  }
}

TEST_CASE("the pairs of both languages name nodes and attributes that they have") {
  const auto find = [](const LanguageRules& rules, std::string_view id) {
    const auto kind = std::ranges::find(rules.kinds, id, [](auto* it) { return it->type.id; });
    REQUIRE(kind != rules.kinds.end());
    return (*kind)->type;
  };
  const auto has = [](const NodeType& type, std::string_view name) {
    return std::ranges::find(type.parameters, name, &Parameter::name) != type.parameters.end();
  };
  for (const btcpp::NodePair& pair : btcpp::node_pairs()) {
    INFO(pair.theirs);
    const NodeType theirs = find(btcpp::kRules, pair.theirs),
                   ours = find(kLockstepRules, pair.ours);
    CHECK((pair.in_theirs.name.empty() || has(theirs, pair.in_theirs.name)));
    CHECK((pair.in_ours.name.empty() || has(ours, pair.in_ours.name)));
    for (const btcpp::AttributePair& it : pair.attributes) {
      INFO(it.theirs);
      CHECK((has(theirs, it.theirs) || it.theirs.ends_with("threshold")));  // before version 4
      CHECK(has(ours, it.ours));
    }
  }
  for (const NodeKind* kind : btcpp::kRules.kinds) {
    if (kind->type.category == NodeCategory::Group) continue;  // beside the trees
    const auto is_it = [&](const btcpp::NodePair& it) { return it.theirs == kind->type.id; };
    INFO(kind->type.id);
    CHECK((std::ranges::any_of(btcpp::node_pairs(), is_it) ||
           std::ranges::any_of(btcpp::similar_nodes(), is_it)));
  }
}

// The library has no such node.
bool is_ours_alone(const NodeType& type) {
  constexpr std::string_view kOurs[] = {"ParallelAbsolute", "ParallelRelative", "SyncProgress",
                                        "UseResources", "WaitUntil"};
  return type.category == NodeCategory::Group ||
         std::ranges::find(kOurs, type.id) != std::end(kOurs);
}

// A program that uses the library asks for them where no lockstep is.
TEST_CASE("what is generated: the nodes that every tree has, for the SDK") {
  std::set<std::string> ids;
  for (const NodeKind* kind : btcpp::kRules.kinds) {
    const std::string_view id = kind->type.id;
    if (!is_ours_alone(kind->type)) ids.emplace(fmt::format("\"{}\"", id));
  }
  const std::string indent(41, ' ');
  check_generated(
      "plugins/sdk/btcpp/include/behaviortree_cpp/lockstep/node_ids.h",
      fmt::format(
          R"(// The nodes that every tree has. Generated from the rows of the language: ./dev generate.
#pragma once

#include <set>
#include <string>

namespace BT::lockstep_detail {{

inline const std::set<std::string>& node_ids() {{
  static const std::set<std::string> ids{{{}}};
  return ids;
}}

}}  // namespace BT::lockstep_detail
)",
          joined(ids, ",\n" + indent)));
}

// Each header in the folders of the library's nodes is a class that every program may use, but for
// those that are templates over a queue.
TEST_CASE("what is generated: the headers of the classes of nodes, for the SDK") {
  const std::string sdk = "plugins/sdk/btcpp/include/";
  const std::set<std::string> templates{"consume_queue.h", "pop_from_queue.hpp"};
  std::set<std::string> headers;
  for (const char* folder : {"actions", "controls", "decorators"}) {
    const std::string path = fmt::format("behaviortree_cpp/{}", folder);
    for (const auto& it :
         std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/" + sdk + path)) {
      const std::string name = it.path().filename().string();
      if (!templates.contains(name)) headers.insert(fmt::format("\"{}/{}\"", path, name));
    }
  }
  std::size_t width = 0;
  for (const std::string& it : headers) width = std::max(width, it.size());
  std::string text =
      "// The classes of the nodes that every tree has, as the library names them. Generated from\n"
      "// the headers that there are: ./dev generate.\n#pragma once\n\n";
  for (const std::string& it : headers) {
    text += fmt::format("#include {:{}}  // IWYU pragma: export\n", it, width);
  }
  check_generated(sdk + "behaviortree_cpp/lockstep/nodes.h", text);
}

std::string cpp_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// With their ports, for manifests() and writeTreeNodesModelXML().
TEST_CASE("what is generated: the ports of the nodes that every tree has, for the SDK") {
  constexpr std::string_view kTypes[] = {"CONTROL", "DECORATOR", "ACTION", "CONDITION", "SUBTREE"};
  constexpr std::string_view kDirections[] = {"INPUT", "OUTPUT", "INOUT"};
  std::string nodes;
  std::string ports;
  for (const NodeKind* kind : btcpp::kRules.kinds) {
    const NodeType& type = kind->type;
    if (is_ours_alone(type)) continue;
    nodes += fmt::format("    {{{}, NodeType::{}}},\n", cpp_text(type.id),
                         kTypes[static_cast<unsigned>(type.category)]);
    for (const Parameter& it : type.parameters) {
      // The library reads and writes an entry by its name.
      const bool is_both = it.is_key && it.is_generic;
      const Direction direction = is_both ? Direction::InOut : it.direction;
      const std::string given = it.default_text ? cpp_text(*it.default_text) : "nullptr";
      ports +=
          fmt::format("    {{{}, {}, PortDirection::{}, {}, {},\n     {}}},\n", cpp_text(type.id),
                      cpp_text(it.name), kDirections[static_cast<unsigned>(direction)],
                      cpp_text(it.is_generic ? "BT::AnyTypeAllowed" : cpp_type_of(it.type)), given,
                      cpp_text(it.doc));
    }
  }
  check_generated(
      "plugins/sdk/btcpp/include/behaviortree_cpp/lockstep/node_ports.h",
      fmt::format(
          R"(// The nodes that every tree has, with their ports. Generated from the rows of the language:
// ./dev generate.
#pragma once

#include "behaviortree_cpp/basic_types.h"

namespace BT::lockstep_detail {{

struct BuiltinNode {{
  const char* id;
  NodeType type;
}};
struct BuiltinPort {{
  const char* node;
  const char* name;
  PortDirection direction;
  const char* type;
  const char* given;  // its default; null: it has none
  const char* text;
}};

// clang-format off
inline constexpr BuiltinNode kBuiltinNodes[] = {{
{}}};
inline constexpr BuiltinPort kBuiltinPorts[] = {{
{}}};
// clang-format on

}}  // namespace BT::lockstep_detail
)",
          nodes, ports));
}

void check_links(const std::string& page) {
  std::vector<std::string> anchors;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("## ") && !line.starts_with("### ")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find(' ') + 1)) {
      if (c == ' ' || c == '-') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    anchors.push_back(anchor);
  }
  const std::regex link(R"(\]\(#([^)]+)\))");
  for (std::sregex_iterator it(page.begin(), page.end(), link), end; it != end; ++it) {
    INFO((*it)[1].str());
    CHECK(std::ranges::find(anchors, (*it)[1].str()) != anchors.end());
  }
}

TEST_CASE("links inside a page lead to its headings") {
  for (const char* page : kPages) check_links(project_file(page));
}

}  // namespace
}  // namespace lockstep::host::test
