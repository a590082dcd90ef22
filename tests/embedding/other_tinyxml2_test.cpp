// A program that has its own copy of tinyxml2, as one that links BehaviorTree.CPP has: what
// lockstep loads must not come there, since the copy may be of another version.
#include <catch2/catch.hpp>
#include <cstddef>
#include <lockstep/runtime.hpp>

namespace tinyxml2 {

namespace {
int calls = 0;
}

// NOLINTNEXTLINE(misc-use-internal-linkage): it is the name that counts
class XMLDocument {
 public:
  int Parse(const char* text, std::size_t length);
};
[[gnu::used]] int XMLDocument::Parse(const char* /*text*/, std::size_t /*length*/) {
  ++calls;
  return 0;
}

}  // namespace tinyxml2

TEST_CASE("a program's own tinyxml2 is not the one that lockstep reads values with") {
  lockstep::runtime::Project project;
  project.load_text(
      R"(<root lockstep="1"><BehaviorTree ID="Main"><Wait name="a &quot;b&#xE4;" seconds="1"/></BehaviorTree></root>)");
  CHECK(project.nodes().back().path == "Main/a \"bä");
  CHECK(tinyxml2::calls == 0);
}
