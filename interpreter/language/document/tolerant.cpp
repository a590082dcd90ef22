#include "language/document/tolerant.h"

#include <algorithm>

#include "language/document/cursor.h"
#include "language/document/well_formed.h"

namespace lockstep::host {
namespace {

class TolerantReader {
 public:
  explicit TolerantReader(std::string_view text) : at_(text) { tree_.text = text; }

  TolerantTree read() {
    while (!at_.at_end()) {
      if (at_.is_at('<')) {
        markup();
      } else {
        content();
      }
    }
    close_down_to(0, at_.position());
    return std::move(tree_);
  }

 private:
  static constexpr auto kNowhere = std::string_view::npos;

  std::size_t find(std::string_view what) const { return tree_.text.find(what, at_.position()); }
  void go_behind(std::string_view end) {
    const auto found = find(end);
    at_.go_to(found == kNowhere ? tree_.text.size() : found + end.size());
  }

  void content() {
    const auto begin = at_.position();
    at_.go_to(std::min(find("<"), tree_.text.size()));
    std::string_view text = tree_.text.substr(begin, at_.position() - begin);
    const auto* const first = std::ranges::find_if_not(text, is_xml_blank);
    if (first == text.end() || open_.empty()) return;
    std::string_view& known = tree_.elements[open_.back()].text;
    if (known.empty()) known = text;
  }

  void markup() {
    const auto begin = at_.position();
    if (at_.skip("<!--")) {
      go_behind("-->");
      tree_.comments.insert(tree_.comments.end(), {begin, at_.position()});
    } else if (at_.skip("<![CDATA[")) {
      go_behind("]]>");
    } else if (at_.rest().starts_with("<?") || at_.rest().starts_with("<!")) {
      go_behind(">");
    } else if (at_.skip("</")) {
      end_tag(begin);
    } else {
      start_tag(begin);
    }
  }

  void end_tag(std::size_t begin) {
    const std::string_view name = at_.take_name();
    at_.skip_blanks();
    at_.skip('>');
    // One that nothing opened is nobody's; one of an outer element closes those in it.
    for (std::size_t depth = open_.size(); depth > 0; --depth) {
      TolerantElement& element = tree_.elements[open_[depth - 1]];
      if (element.tag != name && !(name.empty() && depth == open_.size())) continue;
      close_down_to(depth, begin);
      element.close = begin;
      element.end = at_.position();
      element.is_closed = true;
      element.last = count(tree_.elements);
      open_.pop_back();
      return;
    }
  }

  // Elements that are not closed end here, but for the outer `depth`.
  void close_down_to(std::size_t depth, std::size_t byte) {
    while (open_.size() > depth) {
      TolerantElement& element = tree_.elements[open_.back()];
      element.close = element.end = byte;
      element.last = count(tree_.elements);
      open_.pop_back();
    }
  }

  void start_tag(std::size_t begin) {
    at_.skip('<');
    TolerantElement element;
    element.begin = begin;
    element.tag = at_.take_name();
    if (element.tag.empty()) element.tag = tree_.text.substr(at_.position(), 0);
    element.parent = open_.empty() ? TolerantElement::kNone : open_.back();
    element.first_attribute = count(tree_.attributes);
    const auto number = count(tree_.elements);
    element.last = number + 1;
    if (!element.tag.empty()) attributes();
    element.attribute_count = count(tree_.attributes) - element.first_attribute;
    const bool is_empty = at_.skip("/>");
    element.is_tag_closed = is_empty || at_.skip('>');
    element.is_closed = is_empty;
    element.tag_end = element.close = element.end = at_.position();
    tree_.elements.push_back(element);
    // A start tag that does not end has nothing in it that anybody could know.
    if (element.is_tag_closed && !is_empty && open_.size() < kMaxElementDepth)
      open_.push_back(number);
  }

  // Up to what ends the tag, or begins another.
  void attributes() {
    while (true) {
      at_.skip_blanks();
      if (at_.at_end() || at_.is_at('<') || at_.is_at('>') || at_.rest().starts_with("/>")) return;
      const auto begin = at_.position();
      const std::string_view name = at_.take_name();
      if (name.empty()) {
        at_.go_to(begin + 1);
      } else {
        tree_.attributes.push_back(attribute(begin, name));
      }
    }
  }

  TolerantAttribute attribute(std::size_t begin, std::string_view name) {
    TolerantAttribute it{name};
    it.begin = begin;
    const auto behind_name = at_.position();
    at_.skip_blanks();
    if (!at_.skip('=')) {
      at_.go_to(behind_name);
      return it;
    }
    const auto behind_sign = at_.position();
    at_.skip_blanks();
    if (!at_.is_at('"') && !at_.is_at('\'')) {
      at_.go_to(behind_sign);
      return it;
    }
    it.has_quote = true;
    const auto open = at_.position() + 1;
    const auto end = end_of_value(open, tree_.text[open - 1]);
    it.is_closed = end < tree_.text.size() && tree_.text[end] == tree_.text[open - 1];
    it.value = tree_.text.substr(open, end - open);
    at_.go_to(end + (it.is_closed ? 1 : 0));
    return it;
  }

  // A quote that is forgotten finds the next value's. So a value that seems to have a tag behind a
  // line end, or what looks like the beginning of the next attribute, ends before that.
  std::size_t end_of_value(std::size_t open, char quote) const {
    const std::string_view rest = tree_.text.substr(open);
    const auto closed = rest.find(quote);
    const std::string_view value = rest.substr(0, closed);
    const auto line_end = value.find('\n');
    const bool has_tag = line_end != kNowhere && value.find('<') != kNowhere;
    if (closed != kNowhere && !has_tag && !looks_like_attribute(value)) return open + closed;
    std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
    if (closed != kNowhere && closed < line.size()) {
      line = line.substr(0, closed);
      if (looks_like_attribute(line)) line = line.substr(0, line.find_last_of(" \t"));
    }
    const auto drop_blanks = [&] {
      while (!line.empty() && is_xml_blank(line.back())) line.remove_suffix(1);
    };
    line = line.substr(0, line.find('<'));
    drop_blanks();
    if (line.ends_with('>')) line.remove_suffix(line.ends_with("/>") ? 2 : 1);
    drop_blanks();
    return open + line.size();
  }

  // "… name=", and the next quote behind it.
  static bool looks_like_attribute(std::string_view value) {
    if (!value.ends_with('=')) return false;
    value.remove_suffix(1);
    const auto blank = value.find_last_of(" \t\n");
    if (blank == kNowhere) return false;
    const std::string_view name = value.substr(blank + 1);
    return !name.empty() && xml_name_length(name) == name.size();
  }

  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  Cursor at_;
  TolerantTree tree_;
  std::vector<std::uint32_t> open_;  // elements
};

}  // namespace

std::string_view TolerantTree::value_of(const TolerantElement& element,
                                        std::string_view name) const {
  const auto all = attributes_of(element);
  const auto it = std::ranges::find(all, name, &TolerantAttribute::name);
  return it == all.end() ? std::string_view() : it->value;
}

const TolerantElement* TolerantTree::at(std::size_t byte) const {
  // The last one that begins before the byte, or one around it.
  auto after = std::ranges::lower_bound(elements, byte, {}, &TolerantElement::begin);
  if (after == elements.begin()) return nullptr;
  const TolerantElement* it = &*std::prev(after);
  const auto is_around = [byte](const TolerantElement& element) {
    if (element.has_in_tag(byte)) return true;
    const bool is_before_end = byte < element.end || (byte == element.end && !element.is_closed);
    return element.is_tag_closed && byte >= element.tag_end && is_before_end;
  };
  while (it != nullptr && !is_around(*it)) it = parent_of(*it);
  return it;
}

bool TolerantTree::is_in_comment(std::size_t byte) const {
  const auto after = std::ranges::upper_bound(comments, byte);
  const auto number = after - comments.begin();
  return number % 2 == 1 && byte > comments[static_cast<std::size_t>(number) - 1];
}

TolerantTree read_tolerantly(std::string_view text) {
  return TolerantReader(text).read();
}

}  // namespace lockstep::host
