#include "author/convert/since_4.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "author/convert/blackboard_check.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "dialect/btcpp/version_3.h"
#include "dialect/btcpp/words.h"
#include "language/document/scanner.h"
#include "language/document/text_edit.h"
#include "language/document/value_text.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

class Since4 {
 public:
  Since4(const Document& document, const Catalog& nodes, const Reporter& report)
      : document_(document), nodes_(nodes), report_(report), text_(document.source()->text()) {
    for (const Element& it : document.elements()) has_arguments_ |= it.tag == "arg";
  }

  std::optional<std::string> convert() {
    Scanner scanner(text_, Grammar::Lenient);
    while (true) {
      const XmlToken token = scanner.next();
      switch (token.kind) {
        case TokenKind::OpenTag:
          open(token);
          break;
        case TokenKind::Attribute:
          attribute(token, scanner.offset_of(token.value) + token.value.size() + 1);
          break;
        case TokenKind::TagEnd:
          if (!open_.empty()) insert(token.begin + 1, open_.back().before_children);
          break;
        case TokenKind::EmptyTagEnd:
          if (!open_.empty()) open_.pop_back();
          break;
        case TokenKind::CloseTag:
          close(token);
          break;
        case TokenKind::End:
        case TokenKind::Fault:
          return report_.has_errors() ? std::nullopt : std::optional(edits_.apply(text_));
        default:
          break;
      }
    }
  }

 private:
  struct Open {
    std::string_view tag, since;  // as it is called in both versions
    std::string before_children = {}, behind_children = {};
  };

  void open(const XmlToken& token) {
    element_ = next_++;
    type_ = nullptr;
    check_.reset();
    std::string_view since = token.name;
    if (element_ == 0 && document_.find_attribute(0, "BTCPP_format") == nullptr) {
      edits_.insert(token.begin + 1 + token.name.size(), " BTCPP_format=\"4\"");
    } else if (open_.size() > 1 && element_ < document_.elements().size()) {
      since = node_since_4(token.name);
      if (open_.size() > 2 || open_[1].tag != "TreeNodesModel") convert_node(token.name);
    }
    if (check_) since = "WhileDoElse";
    if (since != token.name) rename(token.begin + 1, token.name, since);
    open_.push_back({token.name, since});
    if (!check_) return;
    open_.back().before_children =
        fmt::format("<ScriptCondition code={}/>", host::quoted(check_->code));
    open_.back().behind_children = fmt::format("<{}/>", check_->otherwise);
  }

  static std::string_view node_since_4(std::string_view id) {
    const auto since = btcpp::node_since_4(id);
    return since.empty() ? id : since;
  }

  void convert_node(std::string_view tag) {
    const Attribute* id = document_.find_attribute(element_, "ID");
    const std::string_view type = is_explicit_tag(tag) && id != nullptr ? id->value : tag;
    type_ = nodes_.find(node_since_4(type));
    if (type_ != nullptr || !is_blackboard_check(type)) return;
    check_ = converted_check(document_, element_, type);
    if (check_->problem.empty()) return;
    report_.at("not-convertible"_code, check_->place,
               fmt::format("version 4 has no '{}', and {} cannot be expressed", brief(type),
                           check_->problem),
               check_->hint);
  }

  void attribute(const XmlToken& token, std::size_t end) {
    const Attribute* it = element_ < document_.elements().size()
                              ? document_.find_attribute(element_, token.name)
                              : nullptr;
    if (it == nullptr) return;
    if (element_ == 0 && it->name == "BTCPP_format") return replace(token, end, it->name, "4");
    if (open_.size() < 3) return;
    const std::string_view tag = open_.back().tag;
    if (check_ && (is_attribute_of_check(it->name) || it->name == "ID")) {
      std::size_t begin = token.begin;
      while (begin > 0 && is_xml_blank(text_[begin - 1])) --begin;
      return edits_.remove(begin, end);
    }
    if (is_explicit_tag(tag) && it->name == "ID") {
      if (const auto since = node_since_4(it->value); since != it->value) {
        replace(token, end, it->name, since);
      }
      return;
    }
    const std::string_view name =
        type_ == nullptr ? it->name : btcpp::attribute_since_4(*type_, it->name);
    const std::string value = value_since_4(tag, *it, has_arguments_, report_);
    if (name != it->name || value != it->value) replace(token, end, name, value);
  }

  void close(const XmlToken& token) {
    if (open_.empty()) return;
    const Open last = open_.back();
    insert(token.begin, last.behind_children);
    open_.pop_back();
    if (last.tag == token.name && last.since != last.tag) {
      rename(token.begin + 2, token.name, last.since);
    }
  }

  void insert(std::size_t at, const std::string& text) {
    if (!text.empty()) edits_.insert(at, text);
  }

  void rename(std::size_t at, std::string_view name, std::string_view since) {
    edits_.replace(at, at + name.size(), std::string(since));
  }

  void replace(const XmlToken& token, std::size_t end, std::string_view name,
               std::string_view value) {
    edits_.replace(token.begin, end, fmt::format("{}={}", name, quoted(value)));
  }

  const Document& document_;
  const Catalog& nodes_;
  const Reporter& report_;
  const std::string_view text_;
  TextEdit edits_;
  std::vector<Open> open_;
  std::uint32_t next_ = 0, element_ = 0;
  const NodeType* type_ = nullptr;       // of the innermost element, if it is built in
  std::optional<ConvertedCheck> check_;  // the innermost element is one
  bool has_arguments_ = false;           // lockstep reads them in both languages: "${key}" is one
};

}  // namespace

bool is_older_form(const Document& document) {
  const Attribute* format = document.find_attribute(0, "BTCPP_format");
  return &document.rules() != &kLockstepRules && (format == nullptr || format->value == "3");
}

std::string value_since_4(std::string_view tag, const Attribute& it, bool has_arguments,
                          const Reporter& report) {
  const bool is_port = is_port_name(it.name) && it.name != "name" && it.name != "ID";
  if (!is_port) return std::string(it.value);
  const auto value = without_blanks_around(it.value);
  const bool is_dollar = value.starts_with("${") && value.ends_with('}');
  if (is_dollar && !has_arguments) return std::string(value.substr(1));
  const bool is_entry =
      tag == "SubTree" && !it.value.empty() && btcpp::key_of(it.value, it.name).empty();
  if (!is_entry) return std::string(it.value);
  if (!report.counted_only(Severity::Warning)) {
    report.at_value("old-syntax"_code, it.place,
                    fmt::format("'{}' is taken for an entry", brief(it.value)),
                    fmt::format("it was one in a SubTree of version 3; if a text is meant, remove "
                                "the braces that the result has around it: {}=\"{}\"",
                                brief(it.name), brief(it.value)),
                    Severity::Warning);
  }
  return fmt::format("{{{}}}", it.value);
}

std::optional<std::string> convert_since_4(const Document& document, const Catalog& nodes,
                                           const Reporter& report) {
  return Since4(document, nodes, report).convert();
}

}  // namespace lockstep::host
