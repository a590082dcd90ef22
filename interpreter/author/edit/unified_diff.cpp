#include "author/edit/unified_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace lockstep::host {
namespace {

constexpr std::size_t kContext = 3;

using Lines = std::vector<std::string_view>;  // each with its line end

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return lines;
}

// Lines of the text before that become others: [begin, end) there, [new_begin, new_end) after.
struct Change {
  std::size_t begin, end, new_begin, new_end;
};

// Both texts are cut where a patch begins a line and ends one; what is the same at both ends of
// a part is left out.
class Changes {
 public:
  Changes(std::string_view text, const TextEdit& edit)
      : text_(text),
        after_text_(edit.apply(text)),
        old_(lines_of(text)),
        new_(lines_of(after_text_)) {
    for (const Patch& patch : edit.patches()) add(patch);
    finish();
  }

  const Lines& old_lines() const { return old_; }
  const Lines& new_lines() const { return new_; }
  const std::vector<Change>& all() const { return all_; }

 private:
  // The lines with the bytes of a patch, and the line that it ends in.
  void add(const Patch& patch) {
    go_to(patch.begin);
    if (!is_open_ || line_ >= open_.end) {
      finish();
      open_ = {line_, line_, new_line(), new_line()};
      is_open_ = true;
    }
    go_to(patch.end);
    open_.end = std::min(line_ + 1, old_.size());
    grown_ += static_cast<std::ptrdiff_t>(std::ranges::count(patch.text, '\n')) -
              std::ranges::count(text_.substr(patch.begin, patch.end - patch.begin), '\n');
  }

  // To the line with this byte; the end of a text without a last line end is in its last line.
  void go_to(std::size_t byte) {
    while (line_ < old_.size() && old_[line_].ends_with('\n') &&
           begin_ + old_[line_].size() <= byte) {
      begin_ += old_[line_++].size();
    }
  }

  std::size_t new_line() const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(line_) + grown_);
  }

  void finish() {
    if (!is_open_) return;
    is_open_ = false;
    Change it = open_;
    it.new_end = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(it.end) + grown_);
    it.new_end = std::min(it.end == old_.size() ? new_.size() : it.new_end, new_.size());
    while (it.begin < it.end && it.new_begin < it.new_end && old_[it.begin] == new_[it.new_begin]) {
      ++it.begin;
      ++it.new_begin;
    }
    while (it.begin < it.end && it.new_begin < it.new_end &&
           old_[it.end - 1] == new_[it.new_end - 1]) {
      --it.end;
      --it.new_end;
    }
    if (it.begin < it.end || it.new_begin < it.new_end) all_.push_back(it);
  }

  std::string_view text_;
  std::string after_text_;
  Lines old_, new_;
  std::vector<Change> all_;
  Change open_ = {};
  bool is_open_ = false;
  std::size_t line_ = 0, begin_ = 0;  // of the text before: a line, and its first byte
  std::ptrdiff_t grown_ = 0;          // lines, up to there
};

void append(std::string& diff, char sign, std::string_view line) {
  diff += sign;
  diff += line;
  if (!line.ends_with('\n')) diff += "\n\\ No newline at end of file\n";
}

// An empty range is written as the line before it.
std::string range(std::size_t begin, std::size_t count) {
  return count == 1 ? fmt::format("{}", begin + 1)
                    : fmt::format("{},{}", count == 0 ? begin : begin + 1, count);
}

// Changes [first, last), whose contexts touch.
void append_hunk(std::string& diff, const Changes& changes, std::size_t first, std::size_t last) {
  const Lines& old = changes.old_lines();
  const Change &front = changes.all()[first], &back = changes.all()[last - 1];
  const std::size_t before = std::min(front.begin, kContext);
  const std::size_t after = std::min(old.size() - back.end, kContext);
  const std::size_t begin = front.begin - before, new_begin = front.new_begin - before;
  diff += fmt::format("@@ -{} +{} @@\n", range(begin, back.end + after - begin),
                      range(new_begin, back.new_end + after - new_begin));
  std::size_t line = begin;
  for (std::size_t i = first; i < last; ++i) {
    const Change& it = changes.all()[i];
    while (line < it.begin) append(diff, ' ', old[line++]);
    while (line < it.end) append(diff, '-', old[line++]);
    for (std::size_t n = it.new_begin; n < it.new_end; ++n)
      append(diff, '+', changes.new_lines()[n]);
  }
  while (line < back.end + after) append(diff, ' ', old[line++]);
}

}  // namespace

std::string unified_diff(std::string_view path, std::string_view text, const TextEdit& edit) {
  const Changes changes(text, edit);
  const std::vector<Change>& all = changes.all();
  if (all.empty()) return {};
  std::string diff = fmt::format("--- {}\n+++ {}\n", path, path);
  for (std::size_t first = 0, last = 1; first < all.size(); first = last++) {
    while (last < all.size() && all[last].begin - all[last - 1].end <= 2 * kContext) ++last;
    append_hunk(diff, changes, first, last);
  }
  return diff;
}

}  // namespace lockstep::host
