#include "base/core/message_kinds.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "support/generated_file.h"
#include "support/paths.h"

using namespace lockstep::host;

namespace {

std::set<std::string> codes_in_sources() {
  std::set<std::string> codes;
  const std::filesystem::recursive_directory_iterator files(LOCKSTEP_SOURCE_DIR "/interpreter");
  const std::regex code("\"([a-z-]+)\"_code");
  for (const auto& file : files) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream in(file.path());
    const std::string text(std::istreambuf_iterator<char>(in), {});
    for (std::sregex_iterator it(text.begin(), text.end(), code), end; it != end; ++it) {
      codes.insert((*it)[1]);
    }
  }
  return codes;
}

}  // namespace

TEST_CASE("each code of a message has its row, and each row is the code of a message") {
  std::set<std::string> known;
  for (const MessageKind& it : message_kinds()) known.emplace(it.code);
  CHECK(known == codes_in_sources());
  CHECK(std::ranges::is_sorted(message_kinds(), {}, &MessageKind::code));
  CHECK(known.size() == message_kinds().size());
}

TEST_CASE("what is generated: docs/messages.md") {
  std::string page =
      "# Messages\n\n"
      "This page is for everyone who reads messages of lockstep, and for programs that do. It "
      "lists the code at the end of each "
      "message of\n`lockstep check`, `run`, `verify`, `test` and the other commands that read "
      "trees. "
      "`lockstep docs CODE` shows one row.\n\n"
      "A code is stable: programs may rely on it, while the text may change between versions. With "
      "`--format json`, `check` "
      "prints it\nas `code`; with `--format github` it is part of the title. Editors show it next "
      "to the message. "
      "Some kinds are an error, a warning or a\nnote, depending on the tree and the options.\n\n"
      "| Code | Meaning | What to do |\n|---|---|---|\n";
  for (const MessageKind& it : message_kinds()) {
    page.append("| `").append(it.code).append("` | ").append(it.meaning).append(" | ");
    page.append(it.mend).append(" |\n");
  }
  test::check_generated("docs/messages.md", page);
}
