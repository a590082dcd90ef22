// Any text as a script: it is refused with a place in it, or does what a slow interpreter of the
// grammar does, entry by entry.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "language/expression/expression.h"
#include "require.h"
#include "support/script_reference.h"

namespace fuzz_script_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

void check_compiled(const std::string& text) {
  const auto script = Expression::parse(text);
  if (!script) {
    require(!script.error().message.empty() && script.error().offset <= text.size());
    return;
  }
  std::set<std::string> names;
  require(script->uses().size() == script->names().size());
  for (std::size_t i = 0; i < script->names().size(); ++i) {
    const std::string& name = script->names()[i];
    const Expression::Use& use = script->uses()[i];
    require(names.insert(name).second);
    require(text.compare(use.offset, name.size(), name) == 0);
    require(!use.is_made || use.is_assigned);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check_compiled(text);
  const std::string difference = test::disagreement(text);
  if (difference.empty()) return 0;
  std::fprintf(stderr, "%s\n", difference.c_str());
  std::abort();
}

}  // namespace fuzz_script_target
