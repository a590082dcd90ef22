// Documents for BehaviorTree.CPP: what is accepted that is no XML, and what is not.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "language/document/document.h"
#include "language/document/language_of.h"
#include "language/document/project.h"
#include "language/document/ros_packages.h"
#include "unit/document/temporary_directory.h"
#include "unit/document/told.h"

using namespace lockstep::host;

namespace {

using Lines = std::vector<std::string>;

Lines told_of(const std::string& text) {
  Diagnostics diagnostics;
  Document::parse("f", text, diagnostics);
  return told(diagnostics);
}

std::string attribute_of(const std::string& text) {
  Diagnostics diagnostics;
  const auto document = Document::parse("f", text, diagnostics);
  REQUIRE(document);
  return std::string(document->attributes(1)[0].value);
}

}  // namespace

TEST_CASE("the attributes of the root say in which language a text is") {
  const auto is_theirs = [](std::string_view text) { return &language_of(text) == &btcpp::kRules; };
  CHECK(is_theirs("<root BTCPP_format='4'/>"));
  CHECK(is_theirs("<?xml version='1.0'?><!-- <root lockstep='1'/> --><root/>"));
  CHECK(is_theirs("<root main_tree_to_execute='a < b' BTCPP_format='4'><A>"));
  CHECK(is_theirs("<root lockstep='1' BTCPP_format='4'/>"));
  CHECK_FALSE(is_theirs("<root lockstep='1'><A BTCPP_format='4'/></root>"));
  CHECK_FALSE(is_theirs("<tree BTCPP_format='4'/>"));
  CHECK_FALSE(is_theirs("<root BTCPP_format=4/>"));
  CHECK_FALSE(is_theirs(""));
}

TEST_CASE("values with '<' and '&' are as they are written, and places stay exact") {
  CHECK(attribute_of("<root><A x='a < b && c & d &lt; &foo;'/></root>") ==
        "a < b && c & d < &foo;");
  CHECK(attribute_of("<root><A x='a\t b\n&#10;c'/></root>") == "a\t b\n\nc");
  CHECK(told_of("<root><A x='a < b'\n  y='&&' y=''/></root>") ==
        Lines{"f:2:10: attribute 'y' is given twice"});
}

TEST_CASE("what is accepted in a document for BehaviorTree.CPP, and warned of") {
  CHECK(told_of("<root a='1'b='2'/>").empty());
  CHECK(told_of("<!-- a -- b --->\n<root/>").empty());
  CHECK(told_of("<?xml version='1' encoding='latin1'?><root/>").empty());
  CHECK(told_of("<!DOCTYPE any thing><!DOCTYPE root><root/>").empty());
  CHECK(
      told_of("<root><TreeNodesModel><Action>what it is</Action></TreeNodesModel></root>").empty());
  const Lines second{"f:1:8: warning: a second root element is ignored"};
  CHECK(told_of("<root/><root><A x='&amp;'/></root><!-- end -->") == second);
  CHECK(told_of("before <root><![CDATA[in]]></root><![CDATA[after]]>") ==
        Lines{"f:1:1: warning: text is ignored", "f:1:23: warning: text is ignored",
              "f:1:44: warning: text is ignored"});
}

TEST_CASE("a second root element leaves nothing behind") {
  Diagnostics diagnostics;
  const auto document =
      Document::parse("f", "<root><A x='1'/></root><root y='&lt;'><B/></root>", diagnostics);
  REQUIRE(document);
  CHECK(document->elements().size() == 2);
  CHECK(document->attributes(1).size() == 1);
}

TEST_CASE("what is refused in a document for BehaviorTree.CPP") {
  CHECK(told_of("<root>\n<A x=1/></root>") ==
        Lines{"f:2:6: expected a quote before the value of 'x'"});
  CHECK(told_of("<root>\n<A x='1', y='2'/></root>") ==
        Lines{"f:2:9: unexpected ',' in the tag '<A'"});
  CHECK(told_of("<root>\n<A></B></root>") == Lines{"f:2:4: '</B>' closes '<A>', opened at line 2"});
  CHECK(told_of("<root/>\nafter") == Lines{"f:2:1: text after the root element"});
}

TEST_CASE("more texts than anybody reads are not told") {
  std::string text = "<root>";
  for (int i = 0; i < 1000; ++i) text += "<A/>x\n";
  const Lines lines = told_of(text + "</root>");
  CHECK(lines.size() == 100);
}

TEST_CASE("in a document for BehaviorTree.CPP, ${name} is text unless it is declared") {
  Diagnostics diagnostics;
  const auto project = load_project_text(
      "f", "<root><arg name='a' default='1'/><A x='${a} ${b} $${a} $${b} ${'/></root>", Arguments(),
      diagnostics);
  REQUIRE(project);
  CHECK(told(diagnostics).empty());
  CHECK(project->documents[0]->attributes(2)[0].value == "1 ${b} ${a} $${b} ${");
}

TEST_CASE("files of ROS packages are where the user says, else in AMENT_PREFIX_PATH") {
  const TemporaryDirectory files;
  std::filesystem::create_directories(files / "install/share/arms/trees");
  files.write("install/share/arms/trees/a.xml", "<root/>");
  files.write("a.xml", "<root/>");
  const RosPackages packages{.given = {{"here", files / "."}}, .prefixes = {files / "install"}};
  const auto load = [&](const std::string& include, Diagnostics& diagnostics) {
    return load_project_text("f", "<root><include " + include + "/></root>", Arguments(),
                             diagnostics, packages);
  };
  Diagnostics good;
  CHECK(load("ros_pkg='arms' path='trees/a.xml'", good)->documents.size() == 2);
  CHECK(load("ros_pkg='here' path='a.xml'", good)->documents.size() == 2);
  CHECK(load("ros_pkg='none' path='" + (files / "a.xml") + "'", good)->documents.size() == 2);
  CHECK(told(good).empty());
  Diagnostics bad;
  load("ros_pkg='none' path='a.xml'", bad);
  CHECK(told(bad) == Lines{"f:1:25: the ROS package 'none' is not found"});
}
