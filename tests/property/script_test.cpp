// The compiled scripts agree with a slow interpreter of their grammar.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "base/core/random.h"
#include "support/script_reference.h"

namespace lockstep::host::test {
namespace {

// Draws scripts from the grammar, most of which can run.
class ScriptSource {
 public:
  explicit ScriptSource(std::uint64_t seed) : random_(seed, 0) {}

  std::string script() {
    std::string text = statement();
    while (below(3) == 0) text += one_of({";", "; ", " ", ";;\n"}) + statement();
    if (below(8) == 0) text += ";";
    return below(12) == 0 ? damaged(text) : text;
  }

 private:
  std::size_t below(std::size_t end) { return random_.next() % end; }
  std::string one_of(const std::vector<std::string>& words) { return words[below(words.size())]; }

  std::string name() {
    return one_of({"n", "r", "t", "e", "x", "y", "@n", "di", "dd", "db", "dt", "RED", "true"});
  }
  std::string number() {
    return one_of({"0", "1", "2", "3", "0.5", "2.0", "1e3", "7", "0x1f", "9007199254740993", "1.0",
                   "2.50000001", "1e300"});
  }
  std::string text() {
    return one_of(
        {"''", "'a'", "'b'", "'3'", "'2.5x'", "'true'", "'RED'", "\"a b\"", "'-1'", "'inf'"});
  }

  std::string statement() {
    if (below(2) == 0) return value(3);
    return one_of({"n", "r", "t", "e", "x", "y", "@n", "di", "dd", "db", "dt"}) +
           one_of({":=", " := ", "=", "+=", "-=", "*=", "/="}) + value(2);
  }

  std::string value(std::size_t depth) {
    switch (below(depth == 0 ? 4 : 12)) {
      case 0:
      case 1:
        return number();
      case 2:
        return name();
      case 3:
        return text();
      case 4:
        return "(" + (below(4) == 0 ? statement() : value(depth - 1)) + ")";
      case 5:
        return one_of({"-", "!", "~", "- "}) + value(depth - 1);
      case 6:
        return value(depth - 1) + "?" + value(depth - 1) + " : " + value(depth - 1);
      case 7:
        return value(depth - 1) + comparison() + value(depth - 1) + comparison() + value(depth - 1);
      case 8:
        return value(depth - 1) + comparison() + value(depth - 1);
      default:
        return value(depth - 1) +
               one_of({"+", "-", "*", "/", "..", "&", "|", "^", "&&", "||", " + ", " .. "}) +
               value(depth - 1);
    }
  }
  std::string comparison() { return one_of({"==", "!=", "<", "<=", ">", ">="}); }

  // With a character changed, added or taken out.
  std::string damaged(std::string text) {
    const std::string characters = "ab1.:=<>&|^~!?()'; \"@_x%";
    const std::size_t at = below(text.size() + 1);
    const std::string added(1, characters[below(characters.size())]);
    return text.replace(at, below(2), below(3) == 0 ? "" : added);
  }

  RandomStream random_;
};

}  // namespace

TEST_CASE("compiled scripts do what the grammar says, in random scripts") {
  ScriptSource source(20);
  for (int i = 0; i < 50000; ++i) {
    const std::string script = source.script();
    INFO(script);
    REQUIRE(disagreement(script) == "");
  }
}

}  // namespace lockstep::host::test
