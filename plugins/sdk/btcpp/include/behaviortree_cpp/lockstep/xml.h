// Documents of trees as elements: what a program's trees say, before lockstep loads them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"

namespace BT::lockstep_detail {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  // as the document orders them
  std::vector<XmlElement> children;
  std::string text;  // between its children, without the blanks around it
  std::size_t line = 0;

  // Null: there is no such attribute.
  const std::string* find(StringView attribute) const {
    for (const auto& [key, value] : attributes) {
      if (key == attribute) return &value;
    }
    return nullptr;
  }
  std::string get(StringView attribute) const {
    const std::string* const value = find(attribute);
    return value == nullptr ? std::string() : *value;
  }
  void set(StringView attribute, std::string value) {
    for (auto& [key, old] : attributes) {
      if (key == attribute) {
        old = std::move(value);
        return;
      }
    }
    attributes.emplace_back(attribute, std::move(value));
  }
};

// The root of a document; throws RuntimeError, with the line, when it is none.
XmlElement read_xml(StringView text);
// An element with its children, indented.
std::string write_xml(const XmlElement& element, int depth = 0);

// How deep elements may be in each other.
inline constexpr int kDeepestXml = 256;

class XmlReader {
 public:
  explicit XmlReader(StringView text) : text_(text) {}

  XmlElement document() {
    if (StartWith(text_, "\xef\xbb\xbf")) at_ = 3;
    skip_between(nullptr);
    XmlElement root = element(0);
    skip_between(nullptr);
    if (at_ < text_.size()) fail("there is something after the end of the document");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw RuntimeError("the XML of the tree, line ", std::to_string(line()), ": ", what);
  }
  // Where it is now; it only goes on.
  std::size_t line() const {
    for (; counted_ < at_ && counted_ < text_.size(); ++counted_) {
      lines_ += text_[counted_] == '\n' ? 1 : 0;
    }
    return lines_;
  }
  bool is_at(StringView what) const { return StartWith(text_.substr(at_), what); }
  void skip_past(StringView end, const char* what) {
    const std::size_t found = text_.find(end, at_);
    if (found == StringView::npos) fail(StrCat(what, " does not end"));
    at_ = found + end.size();
  }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  // Comments, instructions and blanks; text goes to `inside`, or is an error.
  void skip_between(std::string* inside) {
    while (at_ < text_.size()) {
      if (is_at("<!--")) {
        skip_past("-->", "a comment");
      } else if (is_at("<?")) {
        skip_past("?>", "an instruction");
      } else if (is_at("<![CDATA[")) {
        const std::size_t begin = at_ + 9;
        skip_past("]]>", "a CDATA section");
        if (inside != nullptr) inside->append(text_.substr(begin, at_ - 3 - begin));
      } else if (is_at("<!")) {
        const bool has_definitions = text_.find('[', at_) < text_.find('>', at_);
        if (has_definitions) skip_past("]", "a declaration");
        skip_past(">", "a declaration");
      } else if (text_[at_] == '<') {
        return;
      } else if (is_blank(text_[at_])) {
        if (inside != nullptr && !inside->empty()) *inside += text_[at_];
        ++at_;
      } else {
        if (inside == nullptr) fail("there is text outside of the root");
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        inside->append(unescaped(text_.substr(at_, end - at_)));
        at_ = end;
      }
    }
  }

  std::string read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) &&
           StringView("<>/=\"'!?&").find(text_[at_]) == StringView::npos) {
      ++at_;
    }
    if (begin == at_) fail("a name is missing");
    return std::string(text_.substr(begin, at_ - begin));
  }

  XmlElement element(int depth) {
    if (!is_at("<")) fail("an element is missing");
    if (depth > kDeepestXml) {
      fail(StrCat("elements are in each other more than ", std::to_string(kDeepestXml),
                  " deep; move a part to a tree of its own"));
    }
    XmlElement it;
    it.line = line();
    ++at_;
    it.name = read_name();
    for (skip_blanks(); !is_at(">") && !is_at("/>"); skip_blanks()) read_attribute(it);
    if (is_at("/>")) {
      at_ += 2;
      return it;
    }
    ++at_;
    for (skip_between(&it.text); !is_at("</"); skip_between(&it.text)) {
      if (at_ >= text_.size()) fail(StrCat("<", it.name, "> does not end"));
      it.children.push_back(element(depth + 1));
    }
    at_ += 2;
    const std::string end = read_name();
    if (end != it.name) fail(StrCat("</", end, "> ends <", it.name, ">"));
    skip_blanks();
    if (!is_at(">")) fail(StrCat("</", end, " has no '>'"));
    ++at_;
    while (!it.text.empty() && is_blank(it.text.back())) it.text.pop_back();
    return it;
  }

  void read_attribute(XmlElement& it) {
    if (at_ >= text_.size()) fail(StrCat("<", it.name, " does not end"));
    std::string name = read_name();
    skip_blanks();
    if (!is_at("=")) fail(StrCat("the attribute '", name, "' has no value"));
    ++at_;
    skip_blanks();
    if (!is_at("\"") && !is_at("'")) fail(StrCat("the value of '", name, "' is not in quotes"));
    const char quote = text_[at_];
    const std::size_t begin = ++at_;
    const std::size_t end = text_.find(quote, begin);
    if (end == StringView::npos) fail(StrCat("the value of '", name, "' does not end"));
    if (it.find(name) != nullptr) fail(StrCat("the attribute '", name, "' is there twice"));
    it.attributes.emplace_back(std::move(name), unescaped(text_.substr(begin, end - begin)));
    at_ = end + 1;
  }

  std::string unescaped(StringView text) const {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const std::size_t end = text[i] == '&' ? text.find(';', i) : StringView::npos;
      if (end == StringView::npos) {
        plain += text[i];
        continue;
      }
      plain += character(text.substr(i + 1, end - i - 1));
      i = end;
    }
    return plain;
  }
  std::string character(StringView name) const {
    if (name == "lt") return "<";
    if (name == "gt") return ">";
    if (name == "amp") return "&";
    if (name == "quot") return "\"";
    if (name == "apos") return "'";
    if (!StartWith(name, '#') || name.size() < 2) fail(StrCat("there is no '&", name, ";'"));
    const bool is_hex = name[1] == 'x';
    const StringView digits = name.substr(is_hex ? 2 : 1);
    std::uint32_t code = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, is_hex ? 16 : 10);
    if (error != std::errc() || end != digits.data() + digits.size() || code == 0 ||
        code > 0x10ffff) {
      fail(StrCat("there is no '&", name, ";'"));
    }
    return utf8(code);
  }
  static std::string utf8(std::uint32_t code) {
    if (code < 0x80) return {static_cast<char>(code)};
    std::string text;
    int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr int kFirst[] = {0, 0xc0, 0xe0, 0xf0};
    text += static_cast<char>(kFirst[more] | (code >> 6 * more));
    while (more-- > 0) text += static_cast<char>(0x80 | (code >> 6 * more & 0x3f));
    return text;
  }

  StringView text_;
  std::size_t at_ = 0;
  mutable std::size_t counted_ = 0, lines_ = 1;
};

inline XmlElement read_xml(StringView text) {
  return XmlReader(text).document();
}

inline std::string xml_escaped(StringView text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

inline std::string write_xml(const XmlElement& element, int depth) {
  const std::string indent(static_cast<std::size_t>(depth) * 4, ' ');
  std::string text = indent + "<" + element.name;
  for (const auto& [name, value] : element.attributes) {
    text += StrCat(" ", name, "=\"", xml_escaped(value), "\"");
  }
  if (element.children.empty() && element.text.empty()) return text + "/>\n";
  text += ">" + xml_escaped(element.text);
  if (!element.children.empty()) {
    text += "\n";
    for (const XmlElement& it : element.children) text += write_xml(it, depth + 1);
    text += indent;
  }
  return text + "</" + element.name + ">\n";
}

}  // namespace BT::lockstep_detail
