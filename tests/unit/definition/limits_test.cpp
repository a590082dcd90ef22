// Each limit of a project, at it and one beyond. Nothing is expanded: a tree at the limit of nodes
// takes a gigabyte. The limits of a document are in unit/document, of a recording in
// unit/recording, of a plugin in unit/plugin.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "engine/node_kind.h"
#include "run/loading/plugins.h"
#include "tree/check/check_trees.h"
#include "tree/check/plugin_requests.h"
#include "tree/check/references.h"
#include "tree/definition.h"
#include "unit/document/told.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

std::string repeated(std::size_t times, std::string_view text) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

std::string tree(std::string_view id, std::string_view node) {
  return fmt::format("<BehaviorTree ID=\"{}\">{}</BehaviorTree>", id, node);
}

// A project of these trees, before its subtrees are expanded.
struct Checked {
  explicit Checked(const std::string& inside)
      : project(load_project_text("t.xml", "<root lockstep=\"1\">" + inside + "</root>",
                                  Arguments(), diagnostics)) {
    trees = check_trees(*project, catalog, diagnostics);
    may_expand = check_references(trees, {project->sources, diagnostics});
  }

  Diagnostics diagnostics;
  std::unique_ptr<Project> project;
  Catalog catalog = make_catalog({});
  CheckedTrees trees;
  bool may_expand = false;
};

// The first message without its place; "" when there is none.
std::string message(const std::string& inside) {
  const Checked checked(inside);
  const auto& told = checked.diagnostics.all();
  CHECK((checked.may_expand || !told.empty()));
  return told.empty() ? "" : told[0].message;
}

std::string plugins(std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += fmt::format("<plugin name=\"p{}\"/>", i);
  return all;
}

}  // namespace

TEST_CASE("a tree has at most four million nodes with its subtrees expanded") {
  // 1999 subtrees of 2000 nodes, themselves, and the Parallel that they are in.
  const std::string part =
      tree("Part", "<Sequence>" + repeated(1999, "<Wait seconds=\"0\"/>") + "</Sequence>");
  const auto main = [&](std::string_view more) {
    return part + tree("Main", fmt::format("<Parallel>{}{}</Parallel>",
                                           repeated(1999, "<SubTree ID=\"Part\"/>"), more));
  };
  static_assert(1 + 1999 + 1999 * 2000 == kMaxNodes);
  CHECK(message(main("")) == "");
  CHECK(message(main("<AlwaysSuccess/>")) ==
        "the tree 'Main' has 4000001 nodes with its subtrees expanded");
}

TEST_CASE("a tree is at most a thousand nodes deep with its subtrees expanded") {
  const auto chain = [](std::uint32_t depth) {
    std::string trees = tree("T1", "<AlwaysSuccess/>");
    for (std::uint32_t level = 2; level <= depth; ++level) {
      trees += tree(fmt::format("T{}", level), fmt::format("<SubTree ID=\"T{}\"/>", level - 1));
    }
    return trees;
  };
  CHECK(message(chain(kMaxDepth)) == "");
  CHECK(message(chain(kMaxDepth + 1)) ==
        "the tree 'T1001' is 1001 nodes deep with its subtrees expanded");
}

TEST_CASE("a tree in one file may be as deep as a tree of subtrees") {
  const auto nested = [](std::size_t depth) {
    return tree("Main", repeated(depth - 1, "<Inverter>") + "<AlwaysSuccess/>" +
                            repeated(depth - 1, "</Inverter>"));
  };
  CHECK(message(nested(kMaxDepth)) == "");
  CHECK(message(nested(kMaxDepth + 1)) ==
        "the tree 'Main' is 1001 nodes deep with its subtrees expanded");
}

TEST_CASE("the paths of a tree are at most 512 MiB together") {
  constexpr std::size_t kLeaves = 511;
  const auto named = [](std::size_t sequence, std::size_t last_leaf) {
    return tree("A",
                fmt::format("<Sequence name=\"{}\">{}<AlwaysSuccess name=\"{}\"/></Sequence>",
                            std::string(sequence, 's'), repeated(kLeaves - 1, "<AlwaysSuccess/>"),
                            std::string(last_leaf, 'l')));
  };
  const auto size = [&](std::size_t sequence) {
    return Checked(named(sequence, 1)).trees.trees.at("A").paths_size;
  };
  // A letter of the Sequence is in the paths of all, one of the last leaf in its own.
  const std::size_t sequence = 1 + (kMaxPathBytes - size(1)) / (kLeaves + 1);
  const std::size_t last_leaf = 1 + kMaxPathBytes - size(sequence);
  REQUIRE(last_leaf <= kLeaves + 1);
  CHECK(message(named(sequence, last_leaf)) == "");
  CHECK(message(named(sequence, last_leaf + 1)) ==
        "the paths of all nodes in the tree 'A' are larger than 512 MiB together with its subtrees "
        "expanded");
}

TEST_CASE("a project asks for at most 256 plugins") {
  for (const bool beyond : {false, true}) {
    Diagnostics diagnostics;
    const auto project = load_project_text(
        "t.xml", "<root lockstep=\"1\">" + plugins(kMaxPlugins + (beyond ? 1 : 0)) + "</root>",
        Arguments(), diagnostics);
    CHECK(requested_plugins(*project, diagnostics).size() == kMaxPlugins);
    CHECK(diagnostics.all().size() == (beyond ? 1 : 0));
    if (beyond) CHECK(diagnostics.all()[0].message == "more than 256 plugins");
  }
}

namespace {

// The node, with one parameter as given and those that it cannot do without.
std::string node_with(const NodeType& type, const Parameter& parameter, const std::string& value) {
  std::string text = fmt::format("<{} {}=\"{}\"", type.id, parameter.name, value);
  if (type.category == NodeCategory::Group) text += " name=\"g\"";
  for (const Parameter& other : type.parameters) {
    if (other.required && other.name != parameter.name) {
      const bool is_list = other.type == ValueType::StringList;
      text += fmt::format(" {}=\"{}\"", other.name,
                          is_list ? "a;b" : to_text(Value(other.range.min + 1)));
    }
  }
  const bool lacks_barriers = type.synchronization == Synchronization::Absolute &&
                              !parameter.name.starts_with("barrier") && parameter.name != "delta";
  if (lacks_barriers) text += " barrier_count=\"1\"";
  if (parameter.name == "reaction") text += " pace=\"true\"";  // it has no meaning without
  if (type.arity.min == 0) return text + "/>";
  // Counts of children may be as many as there are.
  return text + ">" + repeated(3, "<AlwaysSuccess/>").substr(0, type.arity.max == 1 ? 16 : 48) +
         fmt::format("</{}>", type.id);
}

// A number as far beyond the end of a range as its type can tell.
std::string beyond(const Parameter& parameter, double end, double direction) {
  if (parameter.type == ValueType::Int) {
    return to_text(Value(static_cast<std::int64_t>(end + direction)));
  }
  return to_text(Value(std::nextafter(end, direction * std::numeric_limits<double>::infinity())));
}

std::string at(const Parameter& parameter, double end) {
  return parameter.type == ValueType::Int ? to_text(Value(static_cast<std::int64_t>(end)))
                                          : to_text(Value(end));
}

}  // namespace

TEST_CASE("every parameter of a built-in node takes the ends of its range and nothing beyond") {
  int ends = 0;
  for (const NodeKind* kind : built_in_kinds()) {
    for (const Parameter& parameter : kind->type.parameters) {
      const auto told = [&](const std::string& value) {
        const std::string node = node_with(kind->type, parameter, value);
        INFO(node);
        const bool is_group = kind->type.category == NodeCategory::Group;
        return message(is_group ? node + tree("A", "<AlwaysSuccess/>") : tree("A", node));
      };
      const auto refused = [&](const std::string& value) {
        return value + " is outside the range of '" + std::string(parameter.name) + "'";
      };
      INFO(kind->type.id << ' ' << parameter.name);
      const Range& range = parameter.range;
      if (std::isfinite(range.min)) {
        const std::string least = at(parameter, range.min), less = beyond(parameter, range.min, -1);
        CHECK(told(least) == (range.min_excluded ? refused(least) : ""));
        CHECK(told(less) == refused(less));
        ++ends;
      }
      if (std::isfinite(range.max)) {
        const std::string more = beyond(parameter, range.max, 1);
        CHECK(told(at(parameter, range.max)) == "");
        CHECK(told(more) == refused(more));
        ++ends;
      }
    }
  }
  CHECK(ends >= 15);
}

}  // namespace lockstep::host::test
