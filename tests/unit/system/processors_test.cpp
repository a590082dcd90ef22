#include "base/system/processors.h"

#include <catch2/catch.hpp>

namespace lockstep::host::test {

TEST_CASE("a list of processors is read, and shown in its shortest form") {
  const auto shown = [](std::string_view text) {
    const auto found = Processors::parse(text);
    return found ? found->text() : "refused";
  };
  CHECK(shown("3") == "3");
  CHECK(shown("0-1,3") == "0-1,3");
  CHECK(shown("3,1,2,2") == "1-3");
  CHECK(shown("0-1023") == "0-1023");
  for (const char* text :
       {"", "-1", "1-", "a", "1,", ",1", "3-1", "1 ", "1-2-3", "1024", "99999999999"}) {
    INFO(text);
    CHECK(shown(text) == "refused");
  }
}

}  // namespace lockstep::host::test
