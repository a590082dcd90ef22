#include "author/format/format.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "author/edit/element_text.h"
#include "author/format/tag_layout.h"
#include "language/document/cursor.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kStep = 2;

// For each start tag in the order of the text: whether its element is kept as it is written, since
// blanks in it belong to a text. The lenient grammar ignores a text beside elements.
std::vector<bool> elements_with_text(std::string_view text, Grammar grammar) {
  struct Seen {
    bool text = false, element = false;
  };
  std::vector<Seen> seen;
  std::vector<std::size_t> open;
  Scanner scanner(text, grammar);
  XmlToken token = scanner.next();
  for (; token.kind != TokenKind::End && token.kind != TokenKind::Fault; token = scanner.next()) {
    if (token.kind == TokenKind::OpenTag) {
      if (!open.empty()) seen[open.back()].element = true;
      open.push_back(seen.size());
      seen.emplace_back();
    } else if (token.kind == TokenKind::EmptyTagEnd || token.kind == TokenKind::CloseTag) {
      if (!open.empty()) open.pop_back();
    } else if (token.kind == TokenKind::Text && !open.empty()) {
      seen[open.back()].text = true;
    }
  }
  std::vector<bool> kept;
  for (const Seen& it : seen)
    kept.push_back(it.text && !(grammar == Grammar::Lenient && it.element));
  return kept;
}

class Formatter {
 public:
  Formatter(const Document& document, const FormatOptions& options, std::string_view line_end)
      : text_(document.source()->text()),
        line_end_(line_end),
        scanner_(text_, grammar_of(document)),
        has_text_(elements_with_text(text_, grammar_of(document))),
        tag_(text_, line_end_, options),
        gaps_(text_) {}

  Gaps run() {
    bool is_end = false;
    while (!is_end) {
      const XmlToken token = scanner_.next();
      is_end = token.kind == TokenKind::End || token.kind == TokenKind::Fault;
      if (as_written_ > 0) {
        keep(token);
      } else {
        lay_out(token);
      }
      before_ = token.kind;
    }
    return std::move(gaps_);
  }

 private:
  void lay_out(const XmlToken& token) {
    switch (token.kind) {
      case TokenKind::OpenTag:
        to_own_line(token.begin);
        tag_.begin(token, kStep * depth_);
        element_ = next_++;
        return;
      case TokenKind::Attribute:
        return tag_.add(token);
      case TokenKind::TagEnd:
        tag_.end(token, gaps_);
        done_ = token.begin + 1;
        ++depth_;
        if (has_text_[element_]) as_written_ = 1;
        return;
      case TokenKind::EmptyTagEnd:
        tag_.end(token, gaps_);
        done_ = token.begin + 2;
        return;
      case TokenKind::CloseTag:
        return close(token);
      case TokenKind::Comment:
        return comment(token);
      case TokenKind::Text:
        return ignored_text(token);
      case TokenKind::Instruction:
      case TokenKind::Doctype:
        to_own_line(token.begin);
        done_ = token.begin + token.value.size();
        return;
      case TokenKind::End:
        return gaps_.set(done_, text_.size(), line_end_);
      case TokenKind::Fault:
        return;
    }
  }

  // Within an element with a text.
  void keep(const XmlToken& token) {
    if (token.kind == TokenKind::OpenTag) {
      ++next_;
      ++as_written_;
    } else if (token.kind == TokenKind::EmptyTagEnd) {
      --as_written_;
    } else if (token.kind == TokenKind::CloseTag && --as_written_ == 0) {
      --depth_;
      end_close_tag(token);
    }
  }

  void close(const XmlToken& token) {
    --depth_;
    if (before_ == TokenKind::TagEnd) {
      gaps_.set(done_, token.begin, {});
    } else {
      to_own_line(token.begin);
    }
    end_close_tag(token);
  }

  void end_close_tag(const XmlToken& token) {
    const std::size_t name_end = token.begin + 2 + token.name.size();
    const std::size_t end = text_.find('>', name_end);
    gaps_.set(name_end, end, {});
    done_ = end + 1;
  }

  // Behind what is before it in its line, or in a separate one.
  void comment(const XmlToken& token) {
    const std::size_t end = text_.find("-->", token.begin + 4) + 3;
    const bool is_behind = done_ > 0 && !has_line_end(done_, token.begin);
    if (is_behind) {
      gaps_.set(done_, token.begin, " ");
    } else {
      to_own_line(token.begin);
      shift_comment(token.begin, end);
    }
    done_ = end;
  }

  // Its other lines move as its first.
  void shift_comment(std::size_t begin, std::size_t end) {
    const auto from = indentation(text_, begin);
    if (!from) return;
    for (auto line = text_.find('\n', begin) + 1; line != 0 && line < end;
         line = text_.find('\n', line) + 1) {
      if (!text_.substr(line).starts_with(*from) || ends_line(line)) continue;
      gaps_.replace(line, line + from->size(), std::string(kStep * depth_, ' '));
    }
  }

  bool ends_line(std::size_t at) const {
    const auto next = text_.find_first_not_of(" \t\r", at);
    return next == std::string_view::npos || text_[next] == '\n';
  }

  // The lenient grammar ignores it.
  void ignored_text(const XmlToken& token) {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", token.begin);
    to_own_line(begin);
    const bool is_section = text_.substr(begin).starts_with("<![CDATA[");
    done_ = is_section ? text_.find("]]>", begin) + 3
                       : scanner_.offset_of(token.value) + token.value.size();
    while (is_xml_blank(text_[done_ - 1])) --done_;
  }

  bool has_line_end(std::size_t begin, std::size_t end) const {
    return text_.substr(begin, end - begin).find('\n') != std::string_view::npos;
  }

  // An empty line before it stays; of several, one.
  void to_own_line(std::size_t begin) {
    if (done_ == 0) return gaps_.set(0, begin, {});
    const auto lines = std::count(text_.begin() + static_cast<std::ptrdiff_t>(done_),
                                  text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    std::string gap(line_end_);
    if (lines > 1) gap += line_end_;
    gaps_.set(done_, begin, gap.append(kStep * depth_, ' '));
  }

  std::string_view text_, line_end_;
  Scanner scanner_;
  std::vector<bool> has_text_;  // of each element
  TagLayout tag_;
  Gaps gaps_;
  std::size_t done_ = 0;        // behind the last token
  std::size_t depth_ = 0;       // of elements
  std::size_t as_written_ = 0;  // open elements in one with a text, that one too
  std::size_t next_ = 0, element_ = 0;
  TokenKind before_ = TokenKind::End;
};

std::vector<Attribute> sorted(std::span<const Attribute> attributes) {
  std::vector<Attribute> all(attributes.begin(), attributes.end());
  std::ranges::stable_sort(all, {}, &Attribute::name);
  return all;
}

bool is_same_element(const Document& a, const Document& b, std::uint32_t element) {
  const Element &one = a.elements()[element], &other = b.elements()[element];
  if (one.tag != other.tag || one.end != other.end) return false;
  return std::ranges::equal(sorted(a.attributes(element)), sorted(b.attributes(element)),
                            [](const Attribute& x, const Attribute& y) {
                              return x.name == y.name && x.value == y.value;
                            });
}

// But for the order of attributes.
bool has_same_elements(const Document& a, const Document& b) {
  const std::size_t count = a.elements().size();
  if (count != b.elements().size() || &a.rules() != &b.rules()) return false;
  for (std::uint32_t element = 0; element < count; ++element)
    if (!is_same_element(a, b, element)) return false;
  return true;
}

}  // namespace

Result<TextEdit> format(const Document& document, const FormatOptions& options) {
  const std::string_view first = line_end_of(document.source()->text());
  Gaps gaps = Formatter(document, options, first).run();
  if (const auto line_end = gaps.line_end().value_or(first); line_end != first) {
    gaps = Formatter(document, options, line_end).run();
  }
  TextEdit edit = gaps.take();
  if (edit.empty()) return edit;
  std::string text = edit.apply(document.source()->text());
  if (text.size() > Document::kMaxBytes) {
    return problem("cannot be formatted: it would be larger than 64 MiB, and no command reads it",
                   "divide it into files, with <include path=\"…\"/>");
  }
  Diagnostics diagnostics;
  const auto after = Document::parse(document.source()->path(), std::move(text), diagnostics);
  if (after == nullptr || !has_same_elements(document, *after)) {
    return problem("cannot be formatted: its meaning would change",
                   "this is a bug in lockstep; please report it with the file");
  }
  return edit;
}

}  // namespace lockstep::host
