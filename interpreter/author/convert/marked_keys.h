// Keys with '_' in front. There, a SubTree with _autoremap does not pass them on; here, it does.
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "author/convert/circumstances.h"
#include "author/convert/convert.h"

namespace lockstep::host {

class MarkedKeys {
 public:
  MarkedKeys(const Document& document, const Conversion& conversion,
             const Circumstances& circumstances);

  using Keys = std::set<std::string_view>;
  // Those by which a SubTree has other entries in the other language, as far as this file shows:
  // keys that its tree uses, and that something else uses, too.
  std::vector<std::string_view> differ(std::uint32_t subtree);

 private:
  void find_in(std::uint32_t tree);
  void find_in_script(std::string_view script, Keys& keys) const;
  // With those of the trees to which it is passed on.
  const Keys& inside(std::uint32_t tree);

  const Document& document_;
  const Conversion& conversion_;
  const Circumstances& circumstances_;
  std::unordered_map<std::uint32_t, Keys> own_, inside_;                     // of trees
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> passed_on_;  // trees by SubTrees
  std::unordered_map<std::uint32_t, int> subtrees_;                          // of each tree
  std::unordered_map<std::string_view, int> trees_;                          // that use each key
  int levels_ = 0;  // of inside(), one in the other
};

}  // namespace lockstep::host
