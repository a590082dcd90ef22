#include "base/core/shortened.h"

#include <catch2/catch.hpp>
#include <string>

#include "base/core/plugin_exception.h"

namespace lockstep::host::test {
namespace {

std::string shortened(const std::string& text) {
  const Shortened it(text);
  CHECK(it.c_str() == std::string(it.text()));
  return it.c_str();
}

TEST_CASE("a text of 500 bytes stays as it is, of a longer one the rest is counted") {
  CHECK(shortened("").empty());
  const std::string whole(500, 'x');
  CHECK(shortened(whole) == whole);
  CHECK(shortened(whole + "y") == whole + " ... (1 more bytes)");
  CHECK(shortened(std::string(100'000'000, 'x')) == whole + " ... (99999500 more bytes)");
}

TEST_CASE("no character is cut") {
  const std::string front(499, 'x');
  CHECK(shortened(front + "\u00e4") == front + " ... (2 more bytes)");
}

TEST_CASE("what was shortened is not shortened again, but never beyond its memory") {
  const std::string once = shortened(std::string(1000, 'x'));
  CHECK(Shortened::as_it_is(once).text() == once);
  CHECK(Shortened::as_it_is(std::string(1000, 'x')).text().size() == 579);
}

struct Says final : std::exception {
  const char* text;
  explicit Says(const char* its_text) : text(its_text) {}
  const char* what() const noexcept override { return text; }
};

TEST_CASE("an exception in words") {
  const auto words = [](const char* what) { return thrown_by([&] { throw Says(what); }); };
  CHECK(words("no arm") == "threw an exception: no arm");
  CHECK(words("") == "threw an exception whose what() is empty");
  CHECK(words(nullptr) == "threw an exception whose what() is NULL");
  CHECK(words(std::string(1000, 'x').c_str()) ==
        "threw an exception: " + std::string(500, 'x') + " ... (500 more bytes)");
  CHECK(thrown_by([] { throw 7; }) == "threw an exception that is not a std::exception");
  CHECK(thrown_by([] {}).empty());
}

TEST_CASE("an exception that was put into words says the same wherever it is caught") {
  const std::string text(1000, 'x');
  const auto rethrown = [&] { rethrowing([&] { throw Says(text.c_str()); }); };
  CHECK(thrown_by(rethrown) == thrown_by([&] { throw Says(text.c_str()); }));
  CHECK(rethrowing([] { return 7; }) == 7);
}

}  // namespace
}  // namespace lockstep::host::test
