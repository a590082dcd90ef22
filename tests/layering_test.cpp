// Who may include whom: what interpreter/CMakeLists.txt says of each room, checked against every
// #include line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/paths.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string_view>;

// `from` is the beginning of names; `to` what belongs to it.
struct Layer {
  std::string_view from;
  Names to;
};

// Files that are in no room, and what they may include.
const std::vector<Layer> kOutside{
    {"interpreter/embedding/",
     {"base/", "language/", "engine/", "judge/", "leaves/", "trace/", "run/", "record/",
      "show/web/", "groot/", "embedding/"}},
    {"interpreter/main.cpp", {"base/", "run/", "cli/"}},
    {"interpreter/leafhost.cpp", {"base/", "leaves/", "run/"}},
    {"plugins/sdk/btcpp/", {"lockstep/", "behaviortree_cpp/"}},
    {"plugins/lockstep_ros/", {"lockstep/", "behaviortree_ros2/"}},
    {"plugins/sdk/examples/team_member.c", {"team.h"}},
    {"plugins/", {"lockstep/"}},
};

// What is not ours, by the beginning of its name, and the only places that may see it.
const std::vector<Layer> kThirdParty{
    {"tinyxml2", {"interpreter/language/document/"}},
    {"dds/", {"interpreter/team/dds/", "plugins/sdk/examples/team_member.c"}},
    {"dlfcn.h",
     {"interpreter/leaves/plugin/open/", "interpreter/base/system/late_library.cpp",
      "interpreter/embedding/project.cpp"}},
    {"CLI/", {"interpreter/cli/"}},
    {"simdjson.h", {"interpreter/base/json/reader.cpp"}},
    {"nlohmann/", {"interpreter/base/json/json.cpp", "interpreter/base/json/message_pack.cpp"}},
    {"utf8proc.h", {"interpreter/base/core/utf8.cpp"}},
    {"microhttpd.h", {"interpreter/show/web/http_server.cpp"}},
    {"zmq.h", {"interpreter/groot/sockets.cpp"}},
    {"boost/", {"interpreter/study/distributions.cpp"}},
    {"zlib.h", {"interpreter/show/web/gzip.cpp", "interpreter/record/use/mcap_file.cpp"}},
    {"zstd.h", {"interpreter/base/compression/"}},
    {"kainjow/", {"interpreter/author/scaffold/render.cpp"}},
    {"sodium.h", {"interpreter/cli/tools/ticket/"}},
    {"lockstep/",
     {"interpreter/engine/leaf_call.h", "interpreter/leaves/", "interpreter/team/",
      "interpreter/run/loading/", "interpreter/cli/", "interpreter/embedding/"}},
};

// What is in each tick formats nothing.
const Names kFormatNothing{"interpreter/engine/", "interpreter/judge/measure/"};

// The rooms of the monitor's page, the lowest first, and what each may import beside its own files.
const std::vector<Layer> kPageRooms{
    {"model", {}},
    {"store", {"model"}},
    {"source", {"store"}},
    {"view/parts", {"model", "preact"}},
    {"view/chart", {"model", "store", "view/parts", "preact", "uplot"}},
    {"view/panels", {"model", "store", "view/parts", "view/chart", "preact"}},
    {"view/timeline", {"model", "store", "view/parts", "preact"}},
    {"view/tree", {"model", "store", "view/parts", "preact", "d3-flextree"}},
    {"view",
     {"model", "store", "view/parts", "view/chart", "view/panels", "view/timeline", "view/tree",
      "preact"}},
    {"", {"store", "source", "view", "preact"}},  // main.tsx
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

// What interpreter/CMakeLists.txt says of a room, as includes name them: "engine/".
struct Room {
  std::string folder;
  std::vector<std::string> depends;
  std::vector<std::string> floors;  // folders in it, the lowest first; "." is what is in no folder

  // Of a file in it: its place in `floors`.
  std::size_t floor_of(std::string_view file) const {
    const std::string_view inside = file.substr(folder.size());
    const auto found = std::ranges::find_if(
        floors, [inside](const std::string& it) { return inside.starts_with(it + '/'); });
    return static_cast<std::size_t>(
        (found == floors.end() ? std::ranges::find(floors, ".") : found) - floors.begin());
  }
};

std::vector<Room> read_rooms() {
  std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / "interpreter/CMakeLists.txt");
  std::vector<Room> rooms;
  for (std::string text; std::getline(stream, text);) {
    constexpr std::string_view kRoom = "lockstep_room(";
    if (!text.starts_with(kRoom)) continue;
    for (std::string more; text.find(')') == std::string::npos && std::getline(stream, more);)
      text += ' ' + more;
    std::istringstream words(text.substr(kRoom.size(), text.find(')') - kRoom.size()));
    Room& room = rooms.emplace_back();
    words >> room.folder;
    room.folder += '/';
    std::string key;
    for (std::string word; words >> word;) {
      const bool is_key = std::ranges::all_of(
          word, [](char letter) { return (letter >= 'A' && letter <= 'Z') || letter == '_'; });
      if (is_key)
        key = word;
      else if (key == "DEPENDS")
        room.depends.push_back(word + '/');
      else if (key == "FLOORS")
        room.floors.push_back(word);
    }
  }
  return rooms;
}

const std::vector<Room>& rooms() {
  static const std::vector<Room> rooms = read_rooms();
  return rooms;
}

// The innermost one; null if the file, from interpreter/, is in none.
const Room* room_of(std::string_view file) {
  const Room* found = nullptr;
  for (const Room& room : rooms()) {
    if (file.starts_with(room.folder) &&
        (found == nullptr || room.folder.size() > found->folder.size()))
      found = &room;
  }
  return found;
}

// A plugin's own files include each other by their places.
bool stays_in_plugin(const Include& include) {
  if (!include.file.starts_with("plugins/")) return false;
  const auto folder = include.file.substr(0, include.file.find('/', 8) + 1);
  const auto target = (fs::path(include.file).parent_path() / include.path).lexically_normal();
  return target.generic_string().starts_with(folder) &&
         fs::exists(fs::path(LOCKSTEP_SOURCE_DIR) / target);
}

bool is_allowed_outside(const Include& include) {
  const auto layer = std::ranges::find_if(
      kOutside, [&](const Layer& it) { return include.file.starts_with(it.from); });
  return layer != kOutside.end() && starts_with_any(include.path, layer->to);
}

// "" when the include is allowed, else what is wrong with it.
std::string broken_layer(const Include& include) {
  constexpr std::string_view kInterpreter = "interpreter/";
  const Room* const from = include.file.starts_with(kInterpreter)
                               ? room_of(std::string_view(include.file).substr(kInterpreter.size()))
                               : nullptr;
  const Room* const to = room_of(include.path);
  if (from == nullptr)
    return is_allowed_outside(include) || stays_in_plugin(include) ? ""
                                                                   : at(include) + "not allowed";
  if (from == to && !from->floors.empty() &&
      to->floor_of(include.path) >
          from->floor_of(std::string_view(include.file).substr(kInterpreter.size())))
    return at(include) + "on a higher floor of its room";
  if (to == nullptr || from == to || std::ranges::count(from->depends, to->folder) != 0) return {};
  return at(include) + fmt::format("may include {{{}}}", fmt::join(from->depends, ", "));
}

std::string broken_third_party(const Include& include) {
  if (include.path.starts_with("fmt/") && starts_with_any(include.file, kFormatNothing))
    return at(include) + "formats nothing";
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

TEST_CASE("layers: the rooms are in the order of their floors") {
  std::set<std::string> lower;
  for (const Room& room : rooms()) {
    for (const std::string& below : room.depends) {
      INFO(room.folder << " depends on " << below);
      CHECK(lower.count(below) == 1);
    }
    lower.insert(room.folder);
  }
  CHECK(lower.size() <= 22);  // so that a reader knows them all
  CHECK(std::ranges::count_if(rooms(), [](const Room& room) { return room.folder == "base/"; }) ==
        1);
}

// Who watches, judges, records or draws a run has its Moments: trace/.
TEST_CASE("layers: nine rooms at most see the engine, and none that watches a run") {
  const Names watch{"trace/", "judge/", "record/", "show/", "study/", "groot/"};
  std::size_t seeing = 1;  // embedding/, which is no room of this list
  for (const Room& room : rooms()) {
    if (std::ranges::count(room.depends, "engine/") == 0) continue;
    ++seeing;
    INFO(room.folder);
    CHECK(!starts_with_any(room.folder, watch));
  }
  CHECK(seeing <= 9);
}

TEST_CASE("layers: a folder includes only the rooms on which it depends") {
  int seen = 0;
  check_all([&](const Include& include) {
    if (!include.quoted) return;
    ++seen;
    if (const auto broken = broken_layer(include); !broken.empty()) FAIL_CHECK(broken);
  });
  CHECK(seen > 100);  // or the reader of #include lines is broken
}

TEST_CASE("layers: a room depends on no other than it includes") {
  constexpr std::string_view kInterpreter = "interpreter/";
  std::map<std::string, std::set<std::string>> included;  // by room
  for (const std::string& file : sources_under("interpreter")) {
    const Room* const from = room_of(std::string_view(file).substr(kInterpreter.size()));
    if (from == nullptr) continue;
    for (const Include& include : includes_of(file)) {
      const Room* const to = room_of(include.path);
      if (include.quoted && to != nullptr) included[from->folder].insert(to->folder);
    }
  }
  // Who loads trees links the list of languages: base/core/language.h.
  included["run/"].insert("dialect/");
  for (const Room& room : rooms()) {
    for (const std::string& below : room.depends) {
      INFO(room.folder << " depends on " << below);
      CHECK(included[room.folder].count(below) == 1);
    }
  }
}

TEST_CASE("layers: a library is seen only where the table says") {
  std::set<std::string> xml;
  check_all([&](const Include& include) {
    if (const auto broken = broken_third_party(include); !broken.empty()) FAIL_CHECK(broken);
    if (include.path.starts_with("tinyxml2")) xml.insert(include.file);
  });
  INFO("tinyxml2 belongs in one source of language/document/: " << fmt::format(
           "{}", fmt::join(xml, ", ")));
  CHECK(xml.size() == 1);
  CHECK(xml.begin()->ends_with(".cpp"));
}

TEST_CASE("layers: a room of the page imports only from those below it") {
  const auto root = fs::path(LOCKSTEP_SOURCE_DIR) / "interpreter/show/web/page/src";
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

// Also not for types alone: who reads one of them has to read all.
TEST_CASE("layers: no files of the page import each other in a circle") {
  const auto root = fs::path(LOCKSTEP_SOURCE_DIR) / "interpreter/show/web/page/src";
  std::map<std::string, std::set<std::string>> open;  // what a file imports, not left out yet
  for (const auto& file : fs::recursive_directory_iterator(root)) {
    if (!file.path().extension().string().starts_with(".ts")) continue;
    auto& imported = open[fs::path(file.path()).replace_extension().generic_string()];
    for (const Include& import : imports_of(file.path())) {
      if (!import.path.starts_with(".")) continue;
      imported.insert(
          (file.path().parent_path() / import.path).lexically_normal().generic_string());
    }
  }
  CHECK(open.size() > 40);
  // Those that import nothing that is left are left out, until none is.
  const auto is_free = [&](const auto& file) {
    return std::ranges::none_of(file.second, [&](const auto& it) { return open.contains(it); });
  };
  while (std::erase_if(open, is_free) != 0) {
  }
  for (const auto& [file, imported] : open) FAIL_CHECK(file << " is in a circle, or imports one");
}

// What is known of a tree after the check is data. So whatever a document is written in, the check
// is the last stage that reads it, and a place needs only its text.
TEST_CASE("layers: no stage after the check sees a document") {
  std::vector<std::string> files{
      "interpreter/tree/check/references.cpp", "interpreter/tree/paths.cpp",
      "interpreter/engine/compile.cpp",        "interpreter/run/loading/tree_properties.cpp",
      "interpreter/describe/tree_drawing.cpp", "interpreter/describe/tree_graph.cpp",
      "interpreter/describe/tree_lines.cpp"};
  for (const char* folder : {"expand", "types", "advise"}) {
    const auto more = sources_under(std::string("interpreter/tree/") + folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  const Names of_places{"language/document/reporter.h", "language/document/sources.h",
                        "language/document/lines.h", "language/document/references.h"};
  std::set<std::string> seen(files.begin(), files.end());
  while (!files.empty()) {
    const std::string file = files.back();
    files.pop_back();
    const auto includes = includes_of(file);
    INFO(file << " is not a file that can be read, or includes nothing");
    CHECK((!includes.empty() || file.ends_with(".h")));
    for (const Include& include : includes) {
      if (!include.quoted || !seen.insert("interpreter/" + include.path).second) continue;
      const bool of_document = include.path.starts_with("language/document/");
      if (of_document && !starts_with_any(include.path, of_places))
        FAIL_CHECK(at(include) + "of a document, after the check");
      files.push_back("interpreter/" + include.path);
    }
  }
}

// A rule that differs is a member of LanguageRules. Only a converter, and Groot2 which draws all
// trees as those of BehaviorTree.CPP, know two languages.
TEST_CASE("layers: nobody asks in which language a tree is written") {
  const Names know{"interpreter/dialect/", "interpreter/author/convert/", "interpreter/groot/"};
  for (const std::string& file : sources_under("interpreter")) {
    if (starts_with_any(file, know)) continue;
    std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (const char* asks : {"btcpp::", "== &kLockstepRules", "!= &kLockstepRules"}) {
      INFO(file << ": " << asks);
      CHECK(text.find(asks) == std::string::npos);
    }
  }
}

// The row of a kind has what others ask (base/core/node_type.h), so that a new kind needs no edit
// there.
TEST_CASE("layers: nobody asks a node kind for its name") {
  const Names know{"interpreter/dialect/", "interpreter/author/convert/"};
  const std::regex asks{R"re(\b(id|kind) [!=]= ")re"};
  for (const std::string& file : sources_under("interpreter")) {
    if (starts_with_any(file, know)) continue;
    std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (line.find("= \"") == line.npos || !std::regex_search(line, asks)) continue;
      FAIL_CHECK(file << ':' << number << ": " << line);
    }
  }
}

// A node kind has its run as a NodeContext. The ticker is for the owner of the run.
TEST_CASE("layers: a node kind does not see the ticker") {
  for (const std::string& file : sources_under("interpreter/engine/nodes")) {
    for (const Include& include : includes_of(file)) {
      if (include.path == "engine/ticker.h") FAIL_CHECK(at(include) + "of the owner of a run");
    }
  }
}

// A node kind knows no definition, only parameters.
TEST_CASE("layers: of the engine, only the compiler sees definitions") {
  for (const std::string& file : sources_under("interpreter/engine")) {
    for (const Include& include : includes_of(file)) {
      if (include.path.starts_with("tree/") && !file.starts_with("interpreter/engine/compile."))
        FAIL_CHECK(at(include) + "only engine/compile may");
    }
  }
}

// The linker takes the functions of one of two types with one name for both.
TEST_CASE("layers: a name is that of one type in the interpreter") {
  const std::regex space{R"(^namespace ([\w:]*) ?\{)"};
  const std::regex type{
      R"(^(?:class|struct|union|enum|enum class)(?: \[\[\w+\]\])? (\w+)(?: final)?(?: : .*)?(?: \{.*)?$)"};
  std::map<std::string, std::string> defined;  // the file of each
  for (const std::string& file : sources_under("interpreter")) {
    std::vector<std::string> spaces;
    std::ifstream stream(fs::path(LOCKSTEP_SOURCE_DIR) / file);
    for (std::string line; std::getline(stream, line);) {
      std::smatch match;
      if (std::regex_search(line, match, space) && line.find('}') == std::string::npos) {
        spaces.push_back(match[1].length() == 0 ? file : match[1].str());
      } else if (line.starts_with("}  // namespace")) {
        spaces.pop_back();
      } else if (std::regex_match(line, match, type)) {
        const std::string name = fmt::format("{}::{}", fmt::join(spaces, "::"), match[1].str());
        const auto [first, is_new] = defined.try_emplace(name, file);
        if (!is_new) FAIL_CHECK(fmt::format("{} in {} and {}", name, first->second, file));
      }
    }
  }
  CHECK(defined.size() > 500);
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

// fmt::format is compiled in the library of fmt. Each unit that uses another one
// compiles all of formatting again, which takes seconds.
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
        CHECK(file == "interpreter/record/json_lines.cpp");
      }
    }
  }
  CHECK(seen > 0);
}

}  // namespace lockstep::host::test
