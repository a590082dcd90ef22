#include <catch2/catch.hpp>

#include "language/document/arguments.h"
#include "language/document/project.h"
#include "unit/document/told.h"

using namespace lockstep::host;

namespace {

using Lines = std::vector<std::string>;

struct Loaded {
  Diagnostics diagnostics;
  std::unique_ptr<Project> project;
};

Loaded load(const std::string& text, const Arguments& arguments = {}) {
  Loaded loaded;
  loaded.project = load_project_text("f", text, arguments, loaded.diagnostics);
  REQUIRE(loaded.project);
  return loaded;
}

std::string value(const Loaded& loaded, std::string_view tag, std::string_view name) {
  const auto& document = *loaded.project->documents.front();
  for (std::uint32_t i = 0; i < document.elements().size(); ++i)
    if (document.elements()[i].tag == tag)
      return std::string(document.find_attribute(i, name)->value);
  return "no such element";
}

std::string with_x(const std::string& written) {
  return "<root lockstep='1'><arg name='a' default='1'/><arg name='b' default='${b2}${a}'/><N x='" +
         written + "'/></root>";
}

}  // namespace

TEST_CASE("an argument is replaced by its default or by what is given") {
  const std::string text =
      "<root main='${a}'><arg name='a' default='one' doc='d'/><arg name='b'/>"
      "<T><N x='${a}-${b}' y='$${a}'/></T></root>";
  const auto loaded = load(text, {{"b", "two"}});
  CHECK(told(loaded.diagnostics).empty());
  CHECK(value(loaded, "root", "main") == "one");
  CHECK(value(loaded, "N", "x") == "one-two");
  CHECK(value(load(text, {{"a", "1"}, {"b", ""}}), "N", "x") == "1-");

  const auto& declared = loaded.project->arguments;
  REQUIRE(declared.size() == 2);
  CHECK(declared[0].name == "a");
  CHECK(declared[0].doc == "d");
  CHECK(declared[0].default_value == "one");
  CHECK(declared[1].default_value == std::nullopt);
  CHECK(declared[1].value == "two");
}

TEST_CASE("where an argument begins and ends in a value") {
  const std::pair<std::string, std::string> rows[] = {
      {"${a}", "1"},
      {"${a}${a}", "11"},
      {"x${a}y", "x1y"},
      {"$${a}", "${a}"},
      {"$$${a}", "$${a}"},
      {"${a}$${a}", "1${a}"},
      {"$a {a} $ {a} $", "$a {a} $ {a} $"},
      {"$&#123;a}", "1"},
      {"{${a}}", "{1}"},
      {"$$", "$$"},
  };
  for (const auto& [written, expected] : rows) {
    INFO(written);
    const auto loaded =
        load("<root lockstep='1'><arg name='a' default='1'/><N x='" + written + "'/></root>");
    CHECK(told(loaded.diagnostics).empty());
    CHECK(value(loaded, "N", "x") == expected);
  }
}

TEST_CASE("what an argument brings is not looked into again") {
  const auto loaded = load(
      "<root lockstep='1'><arg name='a' default='x'/><arg name='b' default='$${a}'/><N "
      "x='${b}'/></root>");
  CHECK(told(loaded.diagnostics).empty());
  CHECK(value(loaded, "N", "x") == "${a}");
  CHECK(value(load("<root lockstep='1'><arg name='a'/><N x='${a}'/></root>", {{"a", "${a}"}}), "N",
              "x") == "${a}");
}

TEST_CASE("a default may use the arguments declared before it") {
  const auto loaded = load(
      "<root lockstep='1'><arg name='a' default='1'/><arg name='b' default='${a}2'/><N "
      "x='${b}'/></root>");
  CHECK(value(loaded, "N", "x") == "12");
  const auto late =
      load("<root lockstep='1'><arg name='b' default='${a}'/><arg name='a' default='1'/></root>");
  CHECK(told(late.diagnostics) == Lines{"f:1:43: unknown argument 'a'"});
}

TEST_CASE("an argument with an error is reported once, and its uses stay as written") {
  const auto loaded = load(with_x("${a} ${b} ${b}"));
  CHECK(told(loaded.diagnostics) == Lines{"f:1:70: unknown argument 'b2'"});
  CHECK(value(loaded, "N", "x") == "${a} ${b} ${b}");

  const auto missing = load("<root lockstep='1'>\n <arg name='a'/><N x='${a}'/></root>");
  CHECK(told(missing.diagnostics) == Lines{"f:2:2: argument 'a' has no default and is not given"});
  CHECK(hints(missing.diagnostics) == Lines{"give it with --arg a=value"});
  CHECK(value(missing, "N", "x") == "${a}");
}

TEST_CASE("an unknown argument is reported at its exact place, with what is declared") {
  const auto loaded = load(
      "<root lockstep='1'>\n<arg name='speed' default='1'/><arg name='b' default=''/>\n"
      "<N x='&lt;é${speed}${sped}'\n   y='\n ${}'/></root>");
  CHECK(told(loaded.diagnostics) ==
        Lines{"f:3:21: unknown argument 'sped'", "f:5:2: unknown argument ''"});
  CHECK(hints(loaded.diagnostics) == Lines{"did you mean 'speed'?", "declared: 'speed', 'b'"});
  CHECK(loaded.diagnostics.all()[0].excerpt.text == "<N x='&lt;é${speed}${sped}'");
}

TEST_CASE("of a value full of unknown arguments some are reported, in good time") {
  std::string value;
  for (int i = 0; i < 200'000; ++i) value += "${y}";
  CHECK(told(load("<root lockstep='1'><N x='" + value + "'/></root>").diagnostics).size() == 10);
}

TEST_CASE("'${' must be closed") {
  const auto loaded = load("<root lockstep='1'><N x='1 ${a' y='$${ $$${'/></root>");
  CHECK(told(loaded.diagnostics) == Lines{"f:1:28: '${' is not closed"});
}

TEST_CASE("an --arg of what is not declared has no place") {
  const auto loaded =
      load("<root lockstep='1'><arg name='speed' default='1'/></root>", {{"sped", "2"}});
  CHECK(told(loaded.diagnostics) == Lines{"unknown argument 'sped' in --arg"});
  CHECK(hints(loaded.diagnostics) == Lines{"did you mean 'speed'?"});
  CHECK(hints(load("<root/>", {{"a", "1"}}).diagnostics) == Lines{"no <arg> is declared"});
}

TEST_CASE("an <arg> is what it may be") {
  struct Row {
    std::string arg, told, hint;
  };
  const Row rows[] = {
      {"<arg default='1'/>", "f:1:20: 'arg' needs the attribute 'name'", ""},
      {"<arg name='a b' default=''/>", "f:1:31: 'a b' is not an identifier",
       "letters, digits and '_', not a digit first"},
      {"<arg name='1a' default=''/>", "f:1:31: '1a' is not an identifier",
       "letters, digits and '_', not a digit first"},
      {"<arg name='' default=''/>", "f:1:31: '' is not an identifier",
       "letters, digits and '_', not a digit first"},
      {"<arg name='a' defualt=''  default=''/>", "f:1:34: unknown attribute 'defualt' of 'arg'",
       "did you mean 'default'?"},
      {"<arg name='a' type='' default=''/>", "f:1:34: unknown attribute 'type' of 'arg'",
       "attributes of 'arg': 'name', 'default', 'doc'"},
      {"<arg name='a' default=''><b/></arg>", "f:1:45: 'arg' cannot contain elements", ""},
      {"<arg name='a' default=''/><arg name='a'/>", "f:1:57: argument 'a' is declared twice",
       "the first is at f:1:31"},
  };
  for (const auto& row : rows) {
    INFO(row.arg);
    const auto loaded = load("<root lockstep='1'>" + row.arg + "</root>");
    CHECK(told(loaded.diagnostics) == Lines{row.told});
    CHECK(hints(loaded.diagnostics) == Lines{row.hint});
  }
}

TEST_CASE("a value cannot grow beyond a limit that is named") {
  const Arguments arguments{{"a", std::string(300 << 10, 'x')}};
  const auto loaded = load(
      "<root lockstep='1'><arg name='a'/><N x='${a}${a}${a}'/><M x='${a}${a}${a}${a}'/></root>",
      arguments);
  CHECK(told(loaded.diagnostics) ==
        Lines{"f:1:62: the value of 'x' is larger than 1 MiB with its arguments"});
  CHECK(value(loaded, "N", "x").size() == 3 * (300 << 10));
}

TEST_CASE("the limits of values hold to the byte") {
  constexpr std::size_t kMiB = 1u << 20u;
  const auto told_with = [](std::size_t size, int times, const std::string& more = "") {
    std::string text = "<root lockstep='1'><arg name='a'/>";
    for (int i = 0; i < times; ++i) text += "<N x='${a}'/>";
    return told(load(text + more + "</root>", {{"a", std::string(size, 'x')}}).diagnostics).size();
  };
  CHECK(told_with(kMaxValueMiB * kMiB, 1) == 0);
  CHECK(told_with(kMaxValueMiB * kMiB + 1, 1) == 1);
  CHECK(told_with(kMiB, kMaxExpandedMiB) == 0);
  CHECK(told_with(kMiB, kMaxExpandedMiB - 1, "<N x='${a}'/>") == 0);
  CHECK(
      told_with(kMiB - 1, kMaxExpandedMiB, "<M y='" + std::string(kMaxExpandedMiB, 'y') + "'/>") ==
      0);  // what has no argument does not count
}

TEST_CASE("all values together cannot grow beyond a limit that is named") {
  std::string text = "<root lockstep='1'><arg name='a'/>";
  for (int i = 0; i < 1000; ++i) text += "<N x='${a}'/>";
  const auto loaded = load(text + "</root>", {{"a", std::string(1 << 20, 'x')}});
  CHECK(told(loaded.diagnostics) ==
        Lines{"f:1:873: values with arguments are larger than 64 MiB together"});
}
