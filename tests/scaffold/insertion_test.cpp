// A node is inserted into a source that its author has changed: no byte of the author's goes away.
#include <catch2/catch.hpp>
#include <filesystem>

#include "author/scaffold/plugin_source.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

std::string inserted(const char* language, const std::string& text, const NewNode& node) {
  const auto result = insert_node({"plugin", find_language(language), text}, node);
  if (!result) return "refused: " + result.error().message;
  return *result;
}

// Whether all of `part` is in `whole`, in its order: what is left out was inserted.
bool is_kept(const std::string& part, const std::string& whole) {
  std::size_t at = 0;
  for (const char c : part) {
    at = whole.find(c, at);
    if (at == whole.npos) return false;
    ++at;
  }
  return true;
}

struct Source {
  const char* language;
  std::string text;
  std::string expected;  // a part of the result
};

const NewNode kOpen{NewNodeKind::Condition, "Open", "Opens", {}};

const std::vector<Source> kSources{
    {"cpp", "LOCKSTEP_PLUGIN(\"a\", \"1\", \"x\", lockstep::leaf<A>(\"A\", \"\"));\n",
     "lockstep::leaf<A>(\"A\", \"\"),\n                lockstep::leaf<Open>(\"Open\", "
     "\"Opens\"));\n"},
    {"cpp",
     "// LOCKSTEP_PLUGIN(no)\nLOCKSTEP_PLUGIN(\"a)\", \"1\", R\"x(a \" ) b)x\",\n  "
     "lockstep::leaf<A>(\"A\", \"\")  // last, really\n);\n",
     "lockstep::leaf<A>(\"A\", \"\"),  // last, really\n                "
     "lockstep::leaf<Open>(\"Open\", \"Opens\")\n);\n"},
    {"cpp",
     "namespace {\nclass A {};\n}  // namespace\n\n// The plugin.\nLOCKSTEP_PLUGIN(\"a\", "
     "lockstep::leaf<A>(\"A\", \"\"));\n",
     "bool check() override { return true; }\n};\n\n}  // namespace\n\n// The "
     "plugin.\nLOCKSTEP_PLUGIN("},
    {"cpp", "class A {};\r\n\r\nLOCKSTEP_PLUGIN(\"a\",\r\n  lockstep::leaf<A>(\"A\", \"\"));\r\n",
     "(\"A\", \"\"),\r\n                lockstep::leaf<Open>(\"Open\", \"Opens\"));\r\n"},
    {"python",
     "from lockstep_leaf import Action, serve  # all\n\nclass A(Action):\n    "
     "\"serve()\"\n\n\nserve()\n",
     "import Action, serve, Condition  # all\n"},
    {"python", "from lockstep_leaf import (\n    Action,\n    serve,\n)\nserve()\n",
     "    serve,\n    Condition,\n)\nclass Open(Condition)"},
    {"python", "import lockstep_leaf\nlockstep_leaf.serve\nserve()\n",
     "from lockstep_leaf import Condition\n\n\nclass Open(Condition):"}};

// The sources of plugins in this project, each in its language.
std::vector<PluginSource> all_sources() {
  std::vector<PluginSource> found;
  for (const char* folder :
       {"plugins", "tests/programs", "tests/abi", "tests/cli", "tests/btcpp", "docs"}) {
    const std::filesystem::path root = std::filesystem::path(LOCKSTEP_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      auto source = find_plugin_source(entry.path());
      if (source && source->language->entry_place.empty()) found.push_back(*std::move(source));
    }
  }
  return found;
}

}  // namespace

TEST_CASE("nothing of any plugin of this project changes where a node is inserted") {
  std::size_t changed = 0;
  for (const PluginSource& source : all_sources()) {
    const NewNode node{NewNodeKind::Condition, "Zebra", "", {}};
    const auto result = insert_node(source, node);
    INFO(source.path.string() << (result ? *result : result.error().message));
    if (!result) {
      CHECK(result.error().message.find("has no place for a node") != std::string::npos);
      continue;
    }
    ++changed;
    CHECK(is_kept(source.text, *result));
    CHECK_FALSE(insert_node({source.path, source.language, *result}, node));
  }
  CHECK(changed > 10);
}

TEST_CASE("a node goes behind the last one, and nothing of the author's changes") {
  for (const Source& source : kSources) {
    const std::string result = inserted(source.language, source.text, kOpen);
    INFO(source.language << "\n" << source.text << "----\n" << result);
    CHECK(result.find(source.expected) != result.npos);
    CHECK(is_kept(source.text, result));
    CHECK((result.find("\r\n") == result.npos || result.find("\n\n") == result.npos));
    CHECK(inserted(source.language, result, kOpen) == "refused: 'plugin' has a 'Open' already");
  }
}

TEST_CASE("a second node goes behind the first") {
  for (const Source& source : kSources) {
    const NewNode next{NewNodeKind::Action, "Shut", "", {}};
    const std::string once = inserted(source.language, source.text, kOpen);
    const std::string twice = inserted(source.language, once, next);
    INFO(twice);
    CHECK(is_kept(once, twice));
    CHECK(twice.rfind("Open") < twice.rfind("hut"));
  }
}

TEST_CASE("a long comment anywhere in a source is no harm") {
  const std::string comment = "/*" + std::string(1 << 17, 'x') + "*/";
  for (const Source& source : kSources) {
    if (std::string_view(source.language) == "python") continue;
    for (const char* word : {"(", " ", "{"}) {
      std::string text = source.text;
      const auto at = text.find(word);
      if (at == text.npos) continue;
      inserted(source.language, text.insert(at + 1, comment), kOpen);
    }
  }
  CHECK(inserted("cpp", "class " + comment + " A;\nLOCKSTEP_PLUGIN(\"a\");\n", kOpen)
            .find("class Open") != std::string::npos);
}

TEST_CASE("a source without a list of nodes is refused, and says what was looked for") {
  CHECK(inserted("python", "def f():\n    serve()\n", kOpen) ==
        "refused: 'plugin' has no place for a node: serve() at the begin of a line");
  CHECK(inserted("cpp", "LOCKSTEP_PLUGIN(\"a\", (", kOpen) ==
        "refused: 'plugin' has no place for a node: LOCKSTEP_PLUGIN(…)");
}

}  // namespace lockstep::host::test
