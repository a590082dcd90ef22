#include "base/core/message_kinds.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "language/document/language_of.h"
#include "run/loading/load.h"
#include "support/generated_file.h"
#include "support/paths.h"
#include "tree/mend/mends.h"
#include "verify/check/advice.h"

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

// What `lockstep check` finds in a text.
struct CheckedExample {
  explicit CheckedExample(std::string given) : text(std::move(given)) {
    LoadOptions options;
    options.unknown = MissingNodes::AreNoted;
    options.may_lack_main = true;
    const auto plugins = std::make_shared<PluginSet>();
    Diagnostics found;
    auto loaded = load_text("tree.xml", text, options, found, plugins);
    if (loaded) {
      add_advice(*loaded->project, std::move(loaded->definition), AdviceEffort::Certain, found);
    }
    found.sort();
    messages = found.all();
    catalog = make_catalog(*plugins, language_of(text));
  }

  std::set<std::string> codes() const {
    std::set<std::string> all;
    for (const Diagnostic& it : messages) all.emplace(it.code.text());
    return all;
  }

  std::vector<Mend> mends() const {
    const TolerantTree tree = read_tolerantly(text);
    return Mends(tree, catalog).of(messages.front());
  }

  std::string text;
  std::vector<Diagnostic> messages;
  Catalog catalog;
};

// Its section in docs/messages.md.
std::string section_of(const MessageKind& kind) {
  const CheckedExample example{std::string(kind.example)};
  const Diagnostic& message = example.messages.front();
  std::string section = "\n### `" + std::string(kind.code) + "`\n\n```xml\n" + example.text +
                        "```\n\n```text\n" + render(message, false) + "```\n";
  const auto mends = example.mends();
  if (mends.empty()) return section;
  const bool is_certain = mends.front().is_certain;
  section += "\n" + mends.front().title + (is_certain ? ", which `check --fix` does" : "") +
             ":\n\n```xml\n" + mends.front().edit.apply(example.text) + "```\n";
  return section;
}

}  // namespace

TEST_CASE("the example of each message has it, and its first mend is one") {
  std::size_t examples = 0, mended = 0;
  for (const MessageKind& it : message_kinds()) {
    if (it.example.empty()) continue;
    ++examples;
    INFO(it.code);
    const CheckedExample example{std::string(it.example)};
    REQUIRE(example.codes() == std::set<std::string>{std::string(it.code)});
    const auto mends = example.mends();
    if (mends.empty()) continue;
    ++mended;
    const CheckedExample after(mends.front().edit.apply(example.text));
    INFO(after.text);
    CHECK(!after.codes().contains(std::string(it.code)));
    for (const Diagnostic& message : after.messages) CHECK(message.severity != Severity::Error);
  }
  CHECK(examples > 40);
  CHECK(mended > 20);
}

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
      "- [Codes](#codes) · [Examples](#examples)\n\n## Codes\n\n"
      "| Code | Meaning | What to do |\n|---|---|---|\n";
  for (const MessageKind& it : message_kinds()) {
    page.append("| `").append(it.code).append("` | ").append(it.meaning).append(" | ");
    page.append(it.mend).append(" |\n");
  }
  page +=
      "\n## Examples\n\nWith `--format json`, `check` also prints edits that mend a message, the "
      "best "
      "first: patches of the file, in\nbytes. One that is `certain` is the only way to read what "
      "was "
      "meant: `check --fix` applies it, as often as the\ncheck finds another one. The other edits "
      "need "
      "a decision. Editors offer all of them as quick fixes.\n";
  for (const MessageKind& it : message_kinds())
    if (!it.example.empty()) page += section_of(it);
  test::check_generated("docs/messages.md", page);
}
