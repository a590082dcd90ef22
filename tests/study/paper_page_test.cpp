// The pages that measure claims, those of papers and our own: their commands are run as they stand,
// and the numbers in their tables are what comes out of them.
#include <catch2/catch.hpp>

#include "study/page.h"
#include "support/paths.h"

namespace lockstep::host::test {

TEST_CASE("the numbers of docs/paper.md are those of its studies") {
  check_page(LOCKSTEP_SOURCE_DIR "/docs/paper.md", 13, 1570);
}

TEST_CASE("the numbers of docs/sequel.md are those of its studies") {
  check_page(LOCKSTEP_SOURCE_DIR "/docs/sequel.md", 4, 414);
}

TEST_CASE("the numbers of docs/late_progress.md are those of its studies") {
  check_page(LOCKSTEP_SOURCE_DIR "/docs/late_progress.md", 3, 184);
}

TEST_CASE("the numbers of docs/pacing.md are those of its study") {
  check_page(LOCKSTEP_SOURCE_DIR "/docs/pacing.md", 1, 20);
}

}  // namespace lockstep::host::test
