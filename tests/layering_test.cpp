// Who may include whom: docs/architecture.md's table, checked against every #include line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/paths.h"

namespace lockstep::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string_view>;

// `from` is a folder of the project, or a file of it; `to` what its files may include beside their
// own folder. A file's row is added to its folder's.
struct Layer {
  std::string_view from;
  Names to;
};

const std::vector<Layer> kLayers{
    {"interpreter/core/", {}},
    {"interpreter/system/", {"core/"}},
    {"interpreter/document/", {"core/", "system/"}},
    {"interpreter/expression/", {"core/"}},
    {"interpreter/definition/", {"core/", "document/", "expression/"}},
    {"interpreter/engine/", {"core/", "expression/"}},
    {"interpreter/engine/compile.h", {"definition/"}},
    {"interpreter/engine/compile.cpp", {"definition/"}},
    {"interpreter/engine/nodes/leaf.cpp", {"lockstep/leaf.h"}},
    {"interpreter/dialect/", {"core/", "document/", "definition/", "engine/"}},
    {"interpreter/plugin/", {"core/", "system/", "engine/", "lockstep/leaf.h"}},
    {"interpreter/remote/", {"core/", "system/", "engine/", "plugin/", "lockstep/leaf.h"}},
    {"interpreter/runtime/", {"core/", "system/", "engine/", "plugin/", "measure/"}},
    {"interpreter/measure/", {"core/", "engine/"}},
    {"interpreter/terminal/", {"core/", "system/", "runtime/"}},
    {"interpreter/summary/", {"core/", "engine/", "runtime/", "measure/", "terminal/"}},
    {"interpreter/live/", {"core/", "system/", "engine/", "runtime/", "measure/", "summary/"}},
    {"interpreter/recording/",
     {"core/", "system/", "engine/", "runtime/", "measure/", "terminal/", "summary/", "live/"}},
    {"interpreter/view/",
     {"core/", "system/", "engine/", "runtime/", "measure/", "terminal/", "summary/", "live/",
      "recording/"}},
    {"interpreter/web/", {"core/", "system/", "engine/", "runtime/", "live/", "recording/"}},
    {"interpreter/study/", {"core/", "system/", "engine/", "plugin/", "runtime/", "measure/"}},
    {"interpreter/plots/",
     {"core/", "system/", "runtime/", "measure/", "terminal/", "summary/", "recording/", "study/"}},
    {"interpreter/describe/", {"core/", "definition/"}},
    {"interpreter/convert/", {"core/", "document/", "definition/", "dialect/"}},
    {"interpreter/groot/",
     {"core/", "system/", "definition/", "engine/", "runtime/", "measure/", "live/", "describe/",
      "convert/"}},
    {"interpreter/loading/", {"core/", "document/", "definition/", "engine/", "plugin/"}},
     {"core/", "system/", "definition/", "engine/", "runtime/", "measure/", "recording/", "view/",
      "describe/", "convert/"}},
    {"interpreter/loading/",
     {"core/", "document/", "definition/", "engine/", "plugin/", "remote/", "lockstep/leaf.h"}},
      "describe/", "convert/", "dialect/"}},
    {"interpreter/loading/", {"core/", "document/", "definition/", "engine/", "plugin/"}},
    {"interpreter/embedding/",
     {"core/", "system/", "document/", "definition/", "engine/", "plugin/", "loading/",
      "runtime/"}},
    {"interpreter/cli/",
     {"core/",      "system/",  "document/",      "definition/", "engine/",  "plugin/",
      "loading/",   "runtime/", "measure/",       "terminal/",   "summary/", "live/",
      "recording/", "view/",    "web/",           "study/",      "plots/",   "describe/",
     {"core/",      "system/",  "document/",      "definition/", "engine/",   "plugin/",
      "remote/",    "loading/", "runtime/",       "measure/",    "terminal/", "summary/",
      "recording/", "view/",    "web/",           "study/",      "plots/",    "describe/",
      "convert/",   "groot/",   "lockstep/leaf.h"}},
    {"interpreter/main.cpp", {"core/", "system/", "runtime/", "cli/"}},
    {"interpreter/leafhost.cpp", {"core/", "system/", "remote/", "runtime/"}},
    {"plugins/", {"lockstep/"}},
    {"plugins/sdk/btcpp/", {"behaviortree_cpp/"}},
};

// What is not ours, by the beginning of its name, and the only places that may see it.
const std::vector<Layer> kThirdParty{
    {"tinyxml2", {"interpreter/document/"}},
    {"dlfcn.h", {"interpreter/plugin/open/", "interpreter/embedding/project.cpp"}},
    {"CLI/", {"interpreter/cli/"}},
    {"simdjson.h", {"interpreter/core/json_reader.h", "plugins/motion/recorded.cpp"}},
    {"nlohmann/", {"interpreter/core/json.cpp", "interpreter/core/json_message_pack.cpp"}},
    {"utf8proc.h", {"interpreter/core/utf8.cpp"}},
    {"microhttpd.h", {"interpreter/web/http_server.cpp"}},
    {"zmq.h", {"interpreter/groot/sockets.cpp"}},
    {"boost/", {"interpreter/study/distributions.cpp"}},
    {"zlib.h", {"interpreter/web/gzip.cpp"}},
    {"fmt/", {"interpreter/core/",       "interpreter/system/",     "interpreter/document/",
              "interpreter/expression/", "interpreter/definition/", "interpreter/plugin/",
              "interpreter/loading/",    "interpreter/runtime/",    "interpreter/embedding/",
              "interpreter/terminal/",   "interpreter/summary/",    "interpreter/live/",
              "interpreter/recording/",  "interpreter/view/",       "interpreter/web/",
              "interpreter/study/",      "interpreter/plots/",      "interpreter/describe/",
              "interpreter/convert/",    "interpreter/groot/",      "interpreter/cli/"}},
};

// The rooms of the monitor's page, the lowest first, and what each may import beside its own files.
const std::vector<Layer> kPageRooms{
    {"model", {}},
    {"store", {"model"}},
    {"source", {"store"}},
    {"view/parts", {"model", "preact"}},
    {"view/chart", {"model", "store", "view/parts", "preact", "uplot"}},
    {"view/panels", {"model", "store", "view/parts", "preact"}},
    {"view/timeline", {"model", "store", "view/parts", "preact"}},
    {"view/tree", {"model", "store", "view/parts", "preact", "d3-flextree"}},
    {"view",
     {"model", "store", "view/parts", "view/chart", "view/panels", "view/timeline", "view/tree",
      "preact"}},
    {"", {"store", "source", "view", "preact"}},  // main.tsx
              "interpreter/remote/",     "interpreter/loading/",    "interpreter/runtime/",
              "interpreter/expression/", "interpreter/definition/", "interpreter/dialect/",
              "interpreter/plugin/",     "interpreter/loading/",    "interpreter/runtime/",
              "interpreter/embedding/",  "interpreter/terminal/",   "interpreter/summary/",
              "interpreter/recording/",  "interpreter/view/",       "interpreter/web/",
              "interpreter/study/",      "interpreter/plots/",      "interpreter/describe/",
              "interpreter/convert/",    "interpreter/groot/",      "interpreter/cli/"}},
};

struct Include {
  std::string file;  // from the root of the project
  int line;
  std::string path;
  bool quoted;
};

bool starts_with_any(std::string_view text, const Names& names) {
  return std::any_of(names.begin(), names.end(),
                     [text](std::string_view name) { return text.starts_with(name); });
}

std::vector<Include> includes_of(const std::string& file) {
  std::vector<Include> list;
  std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    const auto open = line.find_first_of("\"<");
    if (line.find("include") > open || open == std::string::npos) continue;
    const auto close = line.find_first_of("\">", open + 1);
    list.push_back({file, number, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return list;
}

bool is_source(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".h" || extension == ".hpp" || extension == ".cpp" || extension == ".c";
}

std::vector<std::string> sources_under(const std::string& folder) {
  std::vector<std::string> files;
  const fs::path root(LOCKSTEP_SOURCE_DIR);
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (entry.is_regular_file() && is_source(entry.path())) {
      files.push_back(fs::relative(entry.path(), root).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string at(const Include& include) {
  return fmt::format("{}:{}: includes '{}': ", include.file, include.line, include.path);
}

// The folder as includes name it: "engine/" of interpreter/engine/ticker.h.
std::string_view own_folder(std::string_view file) {
  if (!file.starts_with("interpreter/")) return {};
  file.remove_prefix(std::string_view("interpreter/").size());
  return file.substr(0, file.find('/') + 1);
}

// A plugin's own files include each other by their places.
bool stays_in_plugin(const Include& include) {
  if (!include.file.starts_with("plugins/")) return false;
  const auto folder = include.file.substr(0, include.file.find('/', 8) + 1);
  const auto target = (fs::path(include.file).parent_path() / include.path).lexically_normal();
  return target.generic_string().starts_with(folder) &&
         fs::exists(fs::path(LOCKSTEP_SOURCE_DIR) / target);
}

// "" when the include is allowed, else what is wrong with it.
std::string broken_layer(const Include& include) {
  Names allowed;
  bool known = false;
  for (const Layer& layer : kLayers) {
    if (!include.file.starts_with(layer.from)) continue;
    known = true;
    allowed.insert(allowed.end(), layer.to.begin(), layer.to.end());
  }
  if (!known) return at(include) + "its folder is not in the table";
  const auto own = own_folder(include.file);
  if (!own.empty() && include.path.starts_with(own)) return {};
  if (starts_with_any(include.path, allowed)) return {};
  if (stays_in_plugin(include)) return {};
  return at(include) + fmt::format("may include {{{}}}", fmt::join(allowed, ", "));
}

std::string broken_third_party(const Include& include) {
  for (const Layer& library : kThirdParty) {
    if (!include.path.starts_with(library.from)) continue;
    if (include.file.starts_with("plugins/") || starts_with_any(include.file, library.to))
      return {};
    return at(include) + fmt::format("only {{{}}} may see it", fmt::join(library.to, ", "));
  }
  return {};
}

// Of a script of the page: what stands behind `from`, at the end of an import.
std::vector<Include> imports_of(const fs::path& file) {
  static const std::regex kFrom("(from|import|import\\() ?\"([^\"]+)\"");
  std::vector<Include> list;
  std::ifstream stream(file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::smatch found;
    if (!std::regex_search(line, found, kFrom)) continue;
    list.push_back({file.generic_string(), number, found[2], false});
  }
  return list;
}

// The room of the page that the import is of, or the package.
std::string room_of(const Include& import, const fs::path& root) {
  if (!import.path.starts_with(".")) return import.path.substr(0, import.path.find('/'));
  const auto target = (fs::path(import.file).parent_path() / import.path).lexically_normal();
  return target.parent_path().lexically_relative(root).generic_string();
}

template <class Check>
void check_all(Check check) {
  for (const char* folder : {"interpreter", "plugins"}) {
    for (const std::string& file : sources_under(folder)) {
      for (const Include& include : includes_of(file)) check(include);
    }
  }
}

}  // namespace

TEST_CASE("layers: a folder includes only what the table allows") {
  int seen = 0;
  check_all([&](const Include& include) {
    if (!include.quoted) return;
    ++seen;
    if (const auto broken = broken_layer(include); !broken.empty()) FAIL_CHECK(broken);
  });
  CHECK(seen > 100);  // or the reader of #include lines is broken
}

TEST_CASE("layers: a library is seen only where the table says") {
  std::set<std::string> xml;
  check_all([&](const Include& include) {
    if (const auto broken = broken_third_party(include); !broken.empty()) FAIL_CHECK(broken);
    if (include.path.starts_with("tinyxml2")) xml.insert(include.file);
  });
  INFO("tinyxml2 belongs in one source of document/: " << fmt::format("{}", fmt::join(xml, ", ")));
  CHECK(xml.size() == 1);
  CHECK(xml.begin()->ends_with(".cpp"));
}

TEST_CASE("layers: a room of the page imports only from those below it") {
  const auto root = fs::path(LOCKSTEP_SOURCE_DIR) / "interpreter/web/page/src";
  const auto row_of = [](const std::string& room) {
    return std::ranges::find(kPageRooms, room == "." ? "" : room, &Layer::from);
  };
  for (auto row = kPageRooms.begin(); row != kPageRooms.end(); ++row) {
    for (const std::string_view below : row->to) {
      INFO(row->from << " may import from " << below << ", whose row is not above its own");
      CHECK(std::none_of(row, kPageRooms.end(), [&](const Layer& it) { return it.from == below; }));
    }
  }
  int seen = 0;
  for (const auto& file : fs::recursive_directory_iterator(root)) {
    if (!file.path().extension().string().starts_with(".ts")) continue;
    const auto own = file.path().parent_path().lexically_relative(root).generic_string();
    const auto row = row_of(own);
    INFO(file.path().generic_string());
    REQUIRE(row != kPageRooms.end());
    for (const Include& import : imports_of(file.path())) {
      ++seen;
      const std::string room = room_of(import, root);
      INFO("line " << import.line << ": imports \"" << import.path << "\"");
      CHECK((room == own || std::ranges::find(row->to, room) != row->to.end()));
    }
  }
  CHECK(seen > 100);
}

// What is known of a tree after the check is data. So whatever a document is written in, the check
// is the last stage that reads it, and a place needs only its text.
TEST_CASE("layers: no stage after the check sees a document") {
  std::vector<std::string> files{
      "interpreter/definition/check/references.cpp", "interpreter/engine/compile.cpp",
      "interpreter/describe/tree_drawing.cpp", "interpreter/describe/tree_graph.cpp",
      "interpreter/describe/tree_lines.cpp"};
  for (const char* folder : {"expand", "types", "advise"}) {
    const auto more = sources_under(std::string("interpreter/definition/") + folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  const Names of_places{"document/reporter.h", "document/sources.h", "document/lines.h",
                        "document/references.h"};
  std::set<std::string> seen(files.begin(), files.end());
  while (!files.empty()) {
    const std::string file = files.back();
    files.pop_back();
    const auto includes = includes_of(file);
    INFO(file << " is not a file that can be read, or includes nothing");
    CHECK((!includes.empty() || file.ends_with(".h")));
    for (const Include& include : includes) {
      if (!include.quoted || !seen.insert("interpreter/" + include.path).second) continue;
      const bool of_document = include.path.starts_with("document/");
      if (of_document && !starts_with_any(include.path, of_places))
        FAIL_CHECK(at(include) + "of a document, after the check");
      files.push_back("interpreter/" + include.path);
    }
  }
}

// A rule that differs is a member of LanguageRules. Only a converter, and Groot2 which draws all
// trees as those of BehaviorTree.CPP, know two languages.
TEST_CASE("layers: nobody asks in which language a tree is written") {
  const Names know{"interpreter/dialect/", "interpreter/convert/", "interpreter/groot/"};
  for (const std::string& file : sources_under("interpreter")) {
    if (starts_with_any(file, know)) continue;
    std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (const char* asks : {"btcpp::", "== &kLockstepRules", "!= &kLockstepRules"}) {
      INFO(file << ": " << asks);
      CHECK(text.find(asks) == std::string::npos);
// A node kind has its run as a NodeContext. The ticker is for the owner of the run.
TEST_CASE("layers: a node kind does not see the ticker") {
  for (const std::string& file : sources_under("interpreter/engine/nodes")) {
    for (const Include& include : includes_of(file)) {
      if (include.path == "engine/ticker.h") FAIL_CHECK(at(include) + "of the owner of a run");
    }
  }
}

// Where files are compiled as one, another one's #include hides that it is missing.
TEST_CASE("layers: a file that formats includes fmt") {
  int seen = 0;
  for (const std::string& file : sources_under("interpreter")) {
    std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.find("fmt::") == std::string::npos) continue;
    ++seen;
    INFO(file);
    CHECK(std::ranges::any_of(includes_of(file), [](const Include& include) {
      return include.path.starts_with("fmt/");
    }));
  }
  CHECK(seen > 100);
}

// fmt::format is compiled in the library of fmt. Each unit that uses another one compiles all of
// formatting again, which takes seconds.
TEST_CASE("layers: only the recorder formats without fmt::format") {
  int seen = 0;
  for (const char* folder : {"interpreter", "plugins"}) {
    for (const std::string& file : sources_under(folder)) {
      std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      for (const char* other : {"fmt::format_to", "fmt::to_string(", "fmt::join(", "fmt::print("}) {
        if (text.find(other) == std::string::npos) continue;
        ++seen;
        INFO(file << ": " << other);
        CHECK(file == "interpreter/recording/write/json_lines.cpp");
      }
    }
  }
  CHECK(seen > 0);
}

}  // namespace lockstep::test
