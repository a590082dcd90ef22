// Texts with '*' and '?'.
#pragma once

#include <string_view>

// Whether the whole text fits: '*' stands for any characters, '?' for one.
inline bool wildcards_match(std::string_view text, std::string_view pattern) {
  while (!pattern.empty() && pattern.front() != '*') {
    if (text.empty() || (pattern.front() != '?' && pattern.front() != text.front())) return false;
    text.remove_prefix(1);
    pattern.remove_prefix(1);
  }
  if (pattern.empty()) return text.empty();
  pattern.remove_prefix(1);
  for (; !text.empty(); text.remove_prefix(1)) {
    if (wildcards_match(text, pattern)) return true;
  }
  return wildcards_match(text, pattern);
}
