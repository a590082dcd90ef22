#include "language/document/text_edit.h"

#include <algorithm>
#include <iterator>

namespace lockstep::host {

void TextEdit::add(TextEdit other) {
  std::ranges::move(other.patches_, std::back_inserter(patches_));
}

std::vector<Patch> TextEdit::patches() const {
  auto sorted = patches_;
  std::ranges::stable_sort(sorted, {}, [](const Patch& it) { return std::pair(it.begin, it.end); });
  std::size_t done = 0;
  std::erase_if(sorted, [&](const Patch& patch) {
    if (patch.begin < done) return true;
    done = patch.end;
    return false;
  });
  return sorted;
}

std::string TextEdit::apply(std::string_view text) const {
  std::string result;
  std::size_t done = 0;
  for (const Patch& patch : patches()) {
    result += text.substr(done, patch.begin - done);
    result += patch.text;
    done = patch.end;
  }
  return result += text.substr(done);
}

TextEdit TextEdit::inverse(std::string_view text) const {
  TextEdit back;
  std::size_t before = 0, after = 0;  // where a patch is: in `text`, and in the changed one
  for (const Patch& patch : patches()) {
    after += patch.begin - before;
    back.replace(after, after + patch.text.size(),
                 std::string(text.substr(patch.begin, patch.end - patch.begin)));
    after += patch.text.size();
    before = patch.end;
  }
  return back;
}

}  // namespace lockstep::host
