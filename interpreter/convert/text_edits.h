// Changes of parts of a text, made all at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

class TextEdits {
 public:
  void replace(std::size_t begin, std::size_t end, std::string text) {
    edits_.push_back({begin, end, std::move(text)});
  }
  void insert(std::size_t at, std::string text) { replace(at, at, std::move(text)); }
  void remove(std::size_t begin, std::size_t end) { replace(begin, end, {}); }

  // Edits within one that was made before them are dropped with it.
  std::string apply(std::string_view text) const {
    auto edits = edits_;
    std::ranges::stable_sort(edits, {}, &Edit::begin);
    std::string result;
    std::size_t done = 0;
    for (const Edit& edit : edits) {
      if (edit.begin < done) continue;
      result += text.substr(done, edit.begin - done);
      result += edit.text;
      done = edit.end;
    }
    return result += text.substr(done);
  }

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Edit> edits_;
};

}  // namespace lockstep::host
