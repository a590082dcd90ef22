// A change of a text: patches of parts of it, made all at once. All that changes a tree file is one
// of these. Its inverse is one too.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep::host {

// Replaces the bytes from `begin` to before `end`.
struct Patch {
  std::size_t begin = 0, end = 0;
  std::string text = {};
};

class TextEdit {
 public:
  void replace(std::size_t begin, std::size_t end, std::string text) {
    patches_.push_back({begin, end, std::move(text)});
  }
  void insert(std::size_t at, std::string text) { replace(at, at, std::move(text)); }
  void remove(std::size_t begin, std::size_t end) { replace(begin, end, {}); }
  void add(TextEdit other);

  bool empty() const { return patches_.empty(); }
  // In the order of the text, none within another: a patch that begins within one before it is
  // dropped. Insertions at one byte stay in the order in which they were made.
  std::vector<Patch> patches() const;
  std::string apply(std::string_view text) const;
  // Changes apply(text) back into `text`.
  TextEdit inverse(std::string_view text) const;

 private:
  std::vector<Patch> patches_;
};

}  // namespace lockstep::host
