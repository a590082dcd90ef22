#include "document/well_formed.h"

#include <fmt/format.h>

#include <algorithm>

#include "document/references.h"

namespace lockstep {
namespace {

// A text with so many is not a tree; each takes memory.
constexpr std::size_t kMaxFaults = 100;

class Checker {
 public:
  explicit Checker(std::string_view text) : text_(text), scanner_(text) {}

  WellFormed run() {
    for (auto token = scanner_.next(); !stopped_; token = scanner_.next()) {
      check(token);
      if (token.kind == TokenKind::End) break;
    }
    return std::move(result_);
  }

 private:
  struct Opened {
    std::string_view name;
    std::size_t offset;
  };

  void check(const Token& token) {
    switch (token.kind) {
      case TokenKind::OpenTag:
        return open(token);
      case TokenKind::Attribute:
        return attribute(token);
      case TokenKind::TagEnd:
        return end_attributes();
      case TokenKind::EmptyTagEnd:
        end_attributes();
        open_.pop_back();
        return;
      case TokenKind::CloseTag:
        return close(token);
      case TokenKind::Text:
        return text(token);
      case TokenKind::Instruction:
        return instruction(token);
      case TokenKind::Doctype:
        if (has_root_) stop({token.begin, "a DOCTYPE stands before the root element"});
        [[fallthrough]];
      case TokenKind::Comment:
        prolog_ = false;
        return;
      case TokenKind::End:
        return end(token);
      case TokenKind::Fault:
        return stop(*scanner_.fault());
    }
  }

  void open(const Token& token) {
    if (open_.empty() && has_root_) return stop({token.begin, "a second root element"});
    if (open_.size() == kMaxElementDepth)
      return stop({token.begin,
                   fmt::format("elements are nested deeper than {} levels", kMaxElementDepth),
                   "the XML reader's limit is 100, and it needs two of them; use a SubTree"});
    open_.push_back({token.name, token.begin});
    ++result_.elements;
    has_root_ = true;
    prolog_ = false;
  }

  void attribute(const Token& token) {
    if (attributes_.size() == kMaxAttributes)
      return stop({token.begin, fmt::format("'{}' has more than {} attributes", open_.back().name,
                                            kMaxAttributes)});
    attributes_.push_back({token.name, token.begin});
    ++result_.attributes;
    for (auto at = token.value.find('&'); at != std::string_view::npos;
         at = token.value.find('&', at + 1)) {
      if (!read_reference(token.value.substr(at)))
        add({scanner_.offset_of(token.value) + at, "'&' begins no reference that is known",
             "write '&amp;' for the character itself"});
    }
  }

  void end_attributes() {
    const std::size_t count = attributes_.size();
    const bool are_two = count == 2 && attributes_[0].name != attributes_[1].name;
    if (count < 2 || are_two) return attributes_.clear();
    // Stable: of two with one name the second is the fault.
    std::stable_sort(attributes_.begin(), attributes_.end(),
                     [](const Opened& a, const Opened& b) { return a.name < b.name; });
    for (std::size_t i = 1; i < attributes_.size(); ++i) {
      const auto& [name, offset] = attributes_[i];
      if (name != attributes_[i - 1].name) continue;
      add({offset, fmt::format("attribute '{}' is given twice", name)});
      result_.readable = false;
    }
    attributes_.clear();
  }

  void close(const Token& token) {
    if (open_.empty())
      return stop({token.begin, fmt::format("'</{}>' closes no element", token.name)});
    const auto& [name, offset] = open_.back();
    if (name != token.name)
      return stop({token.begin, fmt::format("'</{}>' closes '<{}>', opened at line {}", token.name,
                                            name, line_of(offset))});
    open_.pop_back();
  }

  void text(const Token& token) {
    const auto* first = std::find_if_not(token.value.begin(), token.value.end(), is_xml_blank);
    const bool blank = first == token.value.end();
    if (blank) {
      // A blank CDATA section is text to the reader, and outside of the root not XML.
      if (!open_.empty() || text_[token.begin] != '<') return;
    }
    const auto offset = blank ? token.begin : static_cast<std::size_t>(first - text_.data());
    if (open_.empty())
      return stop(
          {offset, fmt::format("text {} the root element", has_root_ ? "after" : "before")});
    add({offset, "text is not part of the language", "put it into a comment: <!-- … -->"});
  }

  void instruction(const Token& token) {
    if (!prolog_) stop({token.begin, "a processing instruction stands at the top of the file"});
  }

  void end(const Token& token) {
    if (!open_.empty()) {
      const auto& [name, offset] = open_.back();
      return stop({offset, fmt::format("'<{}>' is not closed", name),
                   fmt::format("'</{}>' is missing before the end of the file", name)});
    }
    if (!has_root_)
      stop({prolog_ ? 0 : token.begin,
            prolog_ ? "the file is empty" : "the root element is missing"});
  }

  void add(XmlFault fault) {
    if (stopped_) return;
    result_.faults.push_back(std::move(fault));
    if (result_.faults.size() == kMaxFaults) stopped_ = true;
    if (stopped_) result_.readable = false;
  }

  void stop(XmlFault fault) {
    add(std::move(fault));
    result_.readable = false;
    stopped_ = true;
  }

  std::size_t line_of(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + offset, '\n'));
  }

  std::string_view text_;
  Scanner scanner_;
  std::vector<Opened> open_;
  std::vector<Opened> attributes_;
  bool has_root_ = false;
  bool stopped_ = false;
  bool prolog_ = true;  // nothing but processing instructions so far
  WellFormed result_;
};

}  // namespace

WellFormed check_well_formed(std::string_view text) {
  return Checker(text).run();
}

}  // namespace lockstep
