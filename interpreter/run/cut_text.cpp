#include "run/cut_text.h"

#include <fmt/format.h>

#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"

namespace lockstep::host {

std::string cut_text(const Tree& tree, std::span<const std::uint32_t> leaves) {
  std::string text = "cut: the process ends here and is resumed";
  if (leaves.empty()) return text;
  std::vector<std::string> paths;
  for (const std::uint32_t leaf : leaves) paths.push_back(tree.path(tree.leaves[leaf].node));
  const std::vector<std::string_view> names(paths.begin(), paths.end());
  return text + fmt::format("; {} {} again", printable(listed(names)),
                            names.size() == 1 ? "starts" : "start");
}

}  // namespace lockstep::host
