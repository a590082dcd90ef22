// What is XML to lockstep is what is XML to xmllint, but for what our language leaves out of XML.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <regex>
#include <set>

#include "language/document/document.h"
#include "language/document/language_of.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

using Random = std::mt19937;
using Words = std::vector<std::string>;

std::size_t below(Random& random, std::size_t count) {
  return random() % count;
}

const std::string& pick(Random& random, const Words& words) {
  return words[below(random, words.size())];
}

// Mostly "", so that most documents have one thing that may be wrong, not five.
std::string perhaps(Random& random, const Words& words) {
  return below(random, 4) == 0 ? pick(random, words) : "";
}

const Words kDeclarations = {
    "<?xml version=\"1.0\"?>",
    "<?xml version='1.0' encoding='UTF-8'?>",
    "<?xml version=\"1.0\" encoding=\"utf-8\" standalone=\"yes\"?>\n",
    "<?xml version = '1.0'\n standalone='no' ?>",
    "<?xml version=\"1.1\"?>",
    "<?xml version='1.0' encoding='US-ASCII'?>",
    "<?xml\tversion=\"1.0\"\r\n?>",
    "<?xml?>",
    "<?xml ?>",
    "<?xml version=\"2.0\"?>",
    "<?xml version='1.0\"?>",
    "<?xml version=\"1.0\"encoding=\"UTF-8\"?>",
    "<?xml encoding=\"UTF-8\"?>",
    "<?xml version=\"1.0\" encoding=\"UTF-16\"?>",
    "<?xml version=\"1.0\" encoding=\"bogus\"?>",
    "<?xml version=\"1.0\" encoding=\"\"?>",
    "<?xml version='1.0' standalone='yes' encoding='UTF-8'?>",
    "<?xml version='1.0' standalone='maybe'?>",
    "<?xml version='1.0' x='y'?>",
    "<?xml version='1.0'?><?xml version='1.0'?>",
    " <?xml version='1.0'?>",
    "<?XML version='1.0'?>",
    "<?xml version='1.0'",
};
const Words kBetween = {
    "<!-- -->",
    "<!---->",
    "<!-- a - b -->",
    "<!-- a -- b -->",
    "<!-- a --->",
    "<!--->-->",
    "<!-- <r> & -->",
    "<?x?>",
    "<?x y?>",
    "<?x-model a='>'?>",
    "<?1?>",
    "<?\?>",
    "<? x?>",
    "<?x+?>",
    "<?x ?\?>",
    "<?é é?>",
    "<?xml?>",
    "<?xMl x?>",
    "<!-- \xEF\xBF\xBE -->",
    "\n\t ",
    "<!x>",
    "<!",
    "<!-",
};
const Words kDoctypes = {
    "<!DOCTYPE r>",
    "<!DOCTYPE r SYSTEM 'a>b'>",
    "<!DOCTYPE r PUBLIC \"-//a\" 'b'>",
    "<!DOCTYPE>",
    "<!DOCTYPE r x>",
    "<!DOCTYPE r SYSTEM>",
    "<!DOCTYPE r PUBLIC 'a'>",
    "<!DOCTYPE r PUBLIC '{' 'b'>",
    "<!DOCTYPE r SYSTEM 'a' 'b'>",
    "<!DOCTYPE r><!DOCTYPE r>",
    "<!doctype r>",
    "<!DOCTYPE r system 'a'>",
    "<!DOCTYPE 1>",
    "<!DOCTYPE r",
    "<!DOCTYPE  é\n>",
};
const Words kNames = {"a",  "B.c-d", "_1", "é",  "a·", "日本", "1",
                      "-a", "·a",    "×",  "a×", "€",  "a b"};
const Words kValues = {
    "",
    "x",
    "&lt;&amp;&#65;&#x41;",
    "&#xFFFE;",
    "&#0;",
    "&#00000000000000065;",
    "&x;",
    "&",
    "& ",
    "&lt",
    "&#XA;",
    "<",
    ">",
    "]]>",
    "\n\t",
    "{é}",
    "\xEF\xBF\xBF",
    "\x7f",
    "&#xD800;",
    "\xF0\x9F\xBF\xBE",
    "'",
};

std::string attribute(Random& random) {
  const std::string name = below(random, 3) > 0 ? "x" : pick(random, kNames);
  const std::string quote = below(random, 8) > 0 ? "\"" : "";
  return perhaps(random, {" ", "\n"}) + " " + name + "=" + quote + pick(random, kValues) + quote;
}

std::string element(Random& random, int depth) {
  const std::string name = below(random, 4) > 0 ? "e" : pick(random, kNames);
  std::string text = "<" + name;
  for (auto n = below(random, 3); n > 0; --n) text += attribute(random);
  if (depth > 2 || below(random, 3) == 0) return text + perhaps(random, {" ", "/"}) + "/>";
  text += ">";
  for (auto n = below(random, 3); n > 0; --n) {
    text += perhaps(random, kBetween) + element(random, depth + 1);
  }
  return text + "</" + (below(random, 20) > 0 ? name : "f") + perhaps(random, {" "}) + ">";
}

// Several parts of XML, some of which are wrong.
std::string composed(Random& random) {
  return perhaps(random, {"\xEF\xBB\xBF"}) + perhaps(random, kDeclarations) +
         perhaps(random, kBetween) + perhaps(random, kDoctypes) + perhaps(random, kBetween) +
         element(random, 0) + perhaps(random, kBetween) + perhaps(random, {"<r/>", "\n", "</r>"});
}

// A sound document of which a byte or two are others, though not in the declarations: of these
// xmllint takes more than XML allows (version="1.", <!DOCTYPEroot>).
std::string damaged(Random& random) {
  const std::string declarations =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE root SYSTEM ";
  std::string text =
      "\"a\">\n<?model x?>\n<!-- é -->\n<root lockstep=\"1\">\n  <a b='&lt;&#65;' c=\"é\"/>\n  "
      "<d><e/></d>\n</root>\n";
  const std::string bytes = "<>/?!-='\"& \nax1[]\x7f\xC3\xEF\x01";
  for (auto n = 1 + below(random, 2); n > 0; --n) {
    const auto at = below(random, text.size());
    const std::string byte(1, bytes[below(random, bytes.size())]);
    text.replace(at, below(random, 2), below(random, 3) > 0 ? byte : "");
  }
  return declarations + text;
}

enum class Verdict { Xml, NotXml, NotOurs };

// NotOurs: refused because our language has no use for it, whether it is XML or not; or a text for
// BehaviorTree.CPP, in which more is accepted than XML.
Verdict verdict_of(const std::string& text) {
  lockstep::host::Diagnostics diagnostics;
  lockstep::host::Document::parse("f", text, diagnostics);
  if (&lockstep::host::language_of(text) != &lockstep::host::kLockstepRules)
    return Verdict::NotOurs;
  Verdict verdict = Verdict::Xml;
  for (const auto& it : diagnostics.all()) {
    const bool is_ours = it.message == "text is not part of the language" ||
                         it.message == "definitions in a DOCTYPE are not supported";
    if (!is_ours) return Verdict::NotXml;
    verdict = Verdict::NotOurs;
  }
  return verdict;
}

// The numbers of the texts that are not XML.
std::set<std::size_t> refused_by_xmllint(const Words& texts) {
  const TemporaryDirectory directory;
  Invocation call{.arguments = {"--noout", "--nonet"}, .program = "xmllint"};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    call.arguments.push_back(directory.file(std::to_string(i) + ".xml", texts[i]));
  }
  const Outcome outcome = run(call);
  REQUIRE(outcome.code != 127);  // not installed: Debian libxml2-utils
  std::set<std::size_t> refused;
  const std::regex error("/([0-9]+)\\.xml:[0-9]+: parser error : ");
  for (std::sregex_iterator it(outcome.err.begin(), outcome.err.end(), error), end; it != end;
       ++it) {
    refused.insert(std::stoul((*it)[1]));
  }
  return refused;
}

}  // namespace

TEST_CASE("of generated documents, those are XML to lockstep that are XML to xmllint") {
  constexpr std::size_t kDocuments = 3000;
  Random random(20260726);
  Words texts;
  while (texts.size() < kDocuments) {
    texts.push_back(texts.size() % 2 == 0 ? composed(random) : damaged(random));
  }
  const auto refused = refused_by_xmllint(texts);
  std::size_t sound = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Verdict verdict = verdict_of(texts[i]);
    if (verdict == Verdict::NotOurs) continue;
    sound += verdict == Verdict::Xml ? 1 : 0;
    INFO(i << ": " << texts[i]);
    CHECK((verdict == Verdict::NotXml) == refused.contains(i));
  }
  // Both kinds are there in plenty.
  CHECK(sound > kDocuments / 10);
  CHECK(sound < kDocuments * 9 / 10);
}
