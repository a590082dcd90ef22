// The memory of call sites goes from set to set, and each site can be read for ever.
#include "leaves/plugin/contract/call_sites.h"

#include <catch2/catch.hpp>
#include <optional>

namespace lockstep::host::test {
namespace {

const CallSite::Origin& origin() {
  return CallSite::origin_of({.id = "Advance", .plugin = "motion"});
}

void add_many(CallSites& sites, int count) {
  for (int i = 0; i < count; ++i) sites.add("Main/leaf#" + std::to_string(i), origin());
}

}  // namespace

TEST_CASE("a site of a set says what one that lives for ever says") {
  CallSites sites;
  const CallSite& site = sites.add("Main/arm", origin());
  CHECK(site.text() == "'Main/arm' (Advance of plugin 'motion')");
  CHECK(site.text() ==
        CallSite::of({.path = "Main/arm", .id = "Advance", .plugin = "motion"}).text());
  CHECK(site.path == site.shown);
  const CallSite& odd = sites.add("Main/a\x1b[2J", origin());
  CHECK(odd.path == std::string("Main/a\x1b[2J"));
  CHECK(std::string(odd.shown).find('\x1b') == std::string::npos);
  CHECK(CallSite::of_plugin("motion").text() == "");
}

TEST_CASE("sites of one set stay where they are, and stay what they are") {
  CallSites sites;
  std::vector<const CallSite*> all;
  for (int i = 0; i < 50'000; ++i) all.push_back(&sites.add(std::to_string(i), origin()));
  bool is_good = true;
  for (int i = 0; i < 50'000; ++i) is_good = is_good && all[i]->path == std::to_string(i);
  CHECK(is_good);
  const std::string long_path(100'000, 'x');
  CHECK(sites.add(long_path, origin()).path == long_path);
}

TEST_CASE("sets that come and go leave nothing behind that grows") {
  { add_many(std::optional<CallSites>().emplace(), 1000); }
  const std::size_t before = CallSites::bytes_of_all_sets();
  for (int i = 0; i < 100; ++i) {
    CallSites sites;
    add_many(sites, 1000);
  }
  CHECK(CallSites::bytes_of_all_sets() == before);
}

TEST_CASE("a site of a set that has gone can still be read, and its text ends") {
  std::optional<CallSites> first(std::in_place);
  const CallSite& site = first->add("Main/of the first set", origin());
  first.reset();
  CHECK(site.text() == "'Main/of the first set' (Advance of plugin 'motion')");
  for (int i = 0; i < 10; ++i) {
    CallSites other;
    add_many(other, 10'000);
    CHECK(site.text().size() < 100);
    CHECK(site.origin == &origin());
  }
}

}  // namespace lockstep::host::test
