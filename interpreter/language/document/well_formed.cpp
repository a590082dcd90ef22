#include "language/document/well_formed.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "base/core/wording.h"
#include "language/document/references.h"

namespace lockstep::host {
namespace {

// No tree has as many, and each takes memory.
constexpr std::size_t kMaxFaults = 100;

// Many bytes at once: a sum of single bytes, of a block that is short enough for it.
std::size_t occurrences(char mark, std::string_view text) {
  constexpr std::size_t kMost = 240;
  std::size_t count = 0;
  while (!text.empty()) {
    const std::string_view block(text.data(), std::min(text.size(), kMost));
    std::uint8_t found = 0;
    for (const char c : block) found = static_cast<std::uint8_t>(found + (c == mark ? 1 : 0));
    count += found;
    text.remove_prefix(block.size());
  }
  return count;
}

// "&name;"
bool looks_like_reference(std::string_view text) {
  const auto name = xml_name_length(text.substr(1));
  return name > 0 && text.substr(1 + name).starts_with(';');
}

class Checker {
 public:
  Checker(std::string_view text, Place first, Grammar grammar)
      : text_(text),
        first_(first),
        is_lenient_(grammar == Grammar::Lenient),
        scanner_(text, grammar) {
    result_.elements.reserve(at_most('<', "<a/>"));
    result_.attributes.reserve(at_most('=', " a=''"));
  }

  WellFormed run() {
    bool is_end = false;
    while (!stopped_ && !is_end) {
      const XmlToken token = scanner_.next();  // made where it is read: a copy waits for its parts
      check(token);
      is_end = token.kind == TokenKind::End;
    }
    return std::move(result_);
  }

 private:
  void check(const XmlToken& token) {
    switch (token.kind) {
      case TokenKind::OpenTag:
        return open(token);
      case TokenKind::Attribute:
        return attribute(token);
      case TokenKind::TagEnd:
        return end_attributes();
      case TokenKind::EmptyTagEnd:
        end_attributes();
        return end_element();
      case TokenKind::CloseTag:
        return close(token);
      case TokenKind::Text:
        return text(token);
      case TokenKind::Instruction:
        return;
      case TokenKind::Doctype:
        return doctype(token);
      case TokenKind::Comment:
        prolog_ = false;
        return;
      case TokenKind::End:
        return end(token);
      case TokenKind::Fault:
        return stop(*scanner_.fault());
    }
  }

  void open(const XmlToken& token) {
    if (open_.empty() && has_root()) {
      if (!is_lenient_) return stop({token.begin, "a second root element"});
      warn({token.begin, "a second root element is ignored"});
      leave_out_from(count(result_.elements));
    }
    if (open_.size() == kMaxElementDepth)
      return stop({token.begin,
                   fmt::format("elements are nested deeper than {} levels", kMaxElementDepth)});
    open_.push_back(count(result_.elements));
    result_.elements.push_back({token.name, 0, count(result_.attributes), 0, place(token)});
    prolog_ = false;
  }

  void attribute(const XmlToken& token) {
    auto& element = result_.elements.back();
    if (element.attribute_count == kMaxAttributes)
      return stop({token.begin, fmt::format("'{}' has more than {} attributes", brief(element.tag),
                                            kMaxAttributes)});
    ++element.attribute_count;
    if (token.is_coded) result_.coded.push_back(count(result_.attributes));
    result_.attributes.push_back({token.name, token.value, place(token)});
    if (token.is_coded) references(token);
  }

  // All elements from this one on, and their attributes.
  void leave_out_from(std::uint32_t element) {
    if (first_left_out_) return;
    first_left_out_ = {element, count(result_.attributes)};
  }

  void leave_out() {
    if (!first_left_out_) return;
    const auto [element, first] = *first_left_out_;
    const std::uint32_t attribute = first;
    result_.elements.resize(element);
    result_.attributes.resize(attribute);
    std::erase_if(result_.coded, [attribute](std::uint32_t coded) { return coded >= attribute; });
  }

  void references(const XmlToken& token) {
    for (auto at = token.value.find('&'); at != std::string_view::npos;
         at = token.value.find('&', at + 1)) {
      if (read_reference(token.value.substr(at))) continue;
      const auto offset = scanner_.offset_of(token.value) + at;
      constexpr auto kHint = "write '&amp;' for the character itself";
      if (!is_lenient_) {
        add({offset, "'&' does not begin a known reference", kHint});
      } else if (looks_like_reference(token.value.substr(at))) {
        warn({offset, "'&' does not begin a known reference, so it stays as it is", kHint});
      }
    }
  }

  void end_attributes() {
    const auto given =
        std::span(result_.attributes).subspan(result_.elements.back().first_attribute);
    const bool are_two = given.size() == 2 && given[0].name != given[1].name;
    if (given.size() < 2 || are_two) return;
    names_.clear();
    for (const auto& attribute : given) names_.push_back(attribute.name);
    // Stable: of two with the same name, the second is reported.
    std::stable_sort(names_.begin(), names_.end());
    for (std::size_t i = 1; i < names_.size(); ++i) {
      if (names_[i] != names_[i - 1]) continue;
      add({scanner_.offset_of(names_[i]),
           fmt::format("attribute '{}' is given twice", brief(names_[i]))});
      result_.readable = false;
    }
  }

  void end_element() {
    result_.elements[open_.back()].end = count(result_.elements);
    open_.pop_back();
  }

  void close(const XmlToken& token) {
    if (open_.empty())
      return stop({token.begin, fmt::format("'</{}>' closes no element", brief(token.name))});
    if (const auto tag = innermost(); tag != token.name)
      return stop(
          {token.begin, fmt::format("'</{}>' closes '<{}>', opened at line {}", brief(token.name),
                                    brief(tag), line_of(scanner_.offset_of(tag)))});
    end_element();
  }

  void text(const XmlToken& token) {
    // Only a CDATA section is blank here, and XML has none outside of the root.
    const auto* first = std::find_if_not(token.value.begin(), token.value.end(), is_xml_blank);
    const bool blank = first == token.value.end();
    if (blank && !open_.empty()) return;
    const auto offset = blank ? token.begin : static_cast<std::size_t>(first - text_.data());
    const bool is_section = text_.substr(token.begin).starts_with("<![CDATA[");
    if (is_in_models()) return;  // what ports are for
    if (!is_lenient_ && may_have_text()) return element_text(token, is_section);
    if (is_lenient_ && (is_section || !open_.empty() || !has_root()))
      return warn({offset, "text is ignored", "put it into a comment: <!-- … -->"});
    if (open_.empty())
      return stop(
          {offset, fmt::format("text {} the root element", has_root() ? "after" : "before")});
    add({offset, "text is not part of the language", "put it into a comment: <!-- … -->"});
  }

  // Its text is kept as an attribute without a name.
  void element_text(const XmlToken& token, bool is_section) {
    const auto begin = scanner_.offset_of(token.value);
    auto& element = result_.elements.back();
    const bool has_text = element.attribute_count > 0 && result_.attributes.back().name.empty();
    if (open_.back() + 1 != result_.elements.size() || has_text) {
      const bool is_property = innermost() == "property";
      return add({begin, is_property ? "a property has one text" : "an expectation has one text",
                  "move comments out of it"});
    }
    ++element.attribute_count;
    Attribute text{{}, token.value, {first_.byte + static_cast<std::uint32_t>(begin)}};
    XmlToken value = token;
    value.is_coded = !is_section && token.value.find_first_of("&\r") != std::string_view::npos;
    if (value.is_coded) result_.coded.push_back(count(result_.attributes));
    result_.attributes.push_back(text);
    if (value.is_coded) references(value);
  }

  // In a property, and in what a scenario expects.
  bool may_have_text() const {
    const std::size_t depth = open_.size();
    if (depth < 2) return false;
    if (depth == 2 && innermost() == "property") return true;
    const std::string_view around = result_.elements[open_[depth - 2]].tag;
    return innermost() == "expect" && (around == "scenario" || around == "scenarios");
  }

  bool is_in_models() const {
    return open_.size() > 1 && result_.elements[open_[1]].tag == "TreeNodesModel";
  }

  void doctype(const XmlToken& token) {
    if (is_lenient_) return;
    if (has_root()) return stop({token.begin, "a DOCTYPE must be before the root element"});
    if (has_doctype_) return stop({token.begin, "a second DOCTYPE"});
    has_doctype_ = true;
    prolog_ = false;
  }

  void end(const XmlToken& token) {
    if (!open_.empty()) {
      const auto tag = innermost();
      return stop({scanner_.offset_of(tag) - 1, fmt::format("'<{}>' is not closed", brief(tag)),
                   fmt::format("'</{}>' is missing before the end of the file", brief(tag))});
    }
    if (!has_root())
      stop({prolog_ ? 0 : token.begin,
            prolog_ ? "the file is empty" : "the root element is missing"});
    leave_out();
  }

  void warn(XmlFault fault) {
    if (++warnings_ > kMaxFaults) return;
    fault.is_warning = true;
    result_.faults.push_back(std::move(fault));
  }

  void add(XmlFault fault) {
    if (stopped_) return;
    result_.faults.push_back(std::move(fault));
    if (++errors_ == kMaxFaults) stopped_ = true;
    if (stopped_) result_.readable = false;
  }

  void stop(XmlFault fault) {
    add(std::move(fault));
    result_.readable = false;
    stopped_ = true;
  }

  // At most how often `shortest`, which contains `mark`, is in the text. Memory that turns out not
  // to be needed is never touched.
  std::size_t at_most(char mark, std::string_view shortest) const {
    return std::min(occurrences(mark, text_), text_.size() / shortest.size());
  }

  bool has_root() const { return !result_.elements.empty(); }
  std::string_view innermost() const { return result_.elements[open_.back()].tag; }
  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  std::size_t line_of(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + offset, '\n'));
  }

  Place place(const XmlToken& token) const {
    return {first_.byte + static_cast<std::uint32_t>(token.begin)};
  }

  std::string_view text_;
  Place first_;
  bool is_lenient_;
  Scanner scanner_;
  std::vector<std::uint32_t> open_;      // elements
  std::vector<std::string_view> names_;  // of the attributes of one element
  bool stopped_ = false;
  bool has_doctype_ = false;
  std::size_t errors_ = 0, warnings_ = 0;
  // The first element and attribute behind the root.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first_left_out_;
  bool prolog_ = true;  // nothing but processing instructions so far
  WellFormed result_;
};

}  // namespace

WellFormed check_well_formed(std::string_view text, Place first, Grammar grammar) {
  return Checker(text, first, grammar).run();
}

}  // namespace lockstep::host
