#include "author/convert/switch_node.h"

#include <fmt/format.h>

#include <algorithm>

#include "author/convert/number_names.h"
#include "base/core/identifier.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "dialect/btcpp/words.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kFewest = 2, kMost = 6;

bool is_entry_name(std::string_view name) {
  return is_identifier(name) && name != "true" && name != "false";
}

std::string case_name(std::size_t number) {
  return fmt::format("case_{}", number);
}

class Switch {
 public:
  Switch(const Document& document, std::uint32_t element, std::optional<ValueType> type)
      : document_(document), element_(element), type_(type) {}

  ConvertedSwitch to_ours(std::uint32_t cases) {
    const std::string on = on_of("variable");
    std::vector<std::string> values;
    for (std::uint32_t number = 1; number <= cases; ++number) values.push_back(case_of(number));
    compare_cases(values);
    warn_of_names(values);
    add("on", on);
    add("cases", to_text(Value(std::move(values))));
    return std::move(result_);
  }

  ConvertedSwitch to_theirs(std::uint32_t children) {
    add("variable", variable_of("on"));
    const std::string_view text = value_of("cases");
    const auto list = parse_value(ValueType::StringList, text);
    if (!list) return std::move(result_);  // the check has said it
    const auto& cases = std::get<std::vector<std::string>>(*list);
    if (cases.size() < kFewest || cases.size() > kMost) {
      refuse("cases", fmt::format("a Switch with {}", counted(cases.size(), "case")),
             fmt::format("only one with {} to {} can", kFewest, kMost));
    } else if (children != cases.size() + 1) {
      refuse("cases", "a Switch without a child for all other values",
             "add <AlwaysFailure/> as its last child");
    }
    std::vector<std::string> values;
    for (const std::string& it : cases) values.push_back(is_number() ? as_number(it) : it);
    compare_cases(values);
    for (std::size_t i = 0; i < values.size(); ++i) add(case_name(i + 1), values[i]);
    return std::move(result_);
  }

 private:
  std::string_view value_of(std::string_view name) const {
    const Attribute* it = document_.find_attribute(element_, name);
    return it == nullptr ? std::string_view() : it->value;
  }

  void add(std::string name, std::string value) {
    result_.attributes.emplace_back(std::move(name), std::move(value));
  }

  // The first problem is kept.
  void refuse(std::string_view name, std::string problem, std::string hint) {
    if (!result_.problem.empty()) return;
    const Attribute* it = document_.find_attribute(element_, name);
    result_.place = it != nullptr ? it->place : document_.elements()[element_].place;
    result_.problem = std::move(problem);
    result_.hint = std::move(hint);
  }

  bool is_number() const {
    return type_ == ValueType::Bool || type_ == ValueType::Int || type_ == ValueType::Double ||
           type_ == ValueType::Number;
  }

  static bool is_flag(std::string_view text) { return parse_flag(text) && !parse_double(text); }

  // A bool is 1 or 0 there.
  static std::string as_number(const std::string& text) {
    return is_flag(text) ? *parse_flag(text) ? "1" : "0" : text;
  }

  // What is equal to a case in one of the languages only.
  void compare_cases(std::span<const std::string> cases) {
    const auto flag = std::ranges::find_if(cases, is_flag);
    if (type_ != ValueType::String && flag != cases.end()) {
      result_.difference += fmt::format(
          "; a bool is 1 or 0 for BehaviorTree.CPP, and equals the case '{}' in lockstep's "
          "language only",
          brief(*flag));
    }
    const auto number = std::ranges::find_if(
        cases, [](const std::string& text) { return parse_double(text).has_value(); });
    if (!is_number() && number != cases.end()) {
      result_.difference += fmt::format(
          "; another text of the number {} equals that case for BehaviorTree.CPP only, as '07' "
          "equals '7'",
          brief(*number));
    }
  }

  // For BehaviorTree.CPP a text may be the name of a number, too, but not where an entry is a text.
  void warn_of_names(std::span<const std::string> cases) {
    const auto name = std::ranges::find_if(cases, is_in_upper_case);
    if (type_ || name == cases.end()) return;
    result_.difference +=
        fmt::format("; a number to which a program gives the name {} equals that case there only",
                    brief(*name));
  }

  // An entry or a text, as a script.
  std::string on_of(std::string_view name) {
    const std::string_view value = value_of(name);
    const std::string_view key = btcpp::key_of(value, name);
    if (value.empty()) {
      refuse(name, "a Switch without 'variable'", "give it an entry");
    } else if (key.empty() && value.find('\'') != std::string_view::npos) {
      refuse(name, fmt::format("the text '{}'", brief(value)), "it contains a quote");
    } else if (!key.empty() && !is_entry_name(key)) {
      refuse(name, fmt::format("the key '{}'", brief(key)),
             fmt::format("a key is {}", kIdentifierRule));
    }
    return key.empty() ? fmt::format("'{}'", value) : std::string(key);
  }

  std::string case_of(std::uint32_t number) {
    const std::string name = case_name(number);
    const std::string_view value = value_of(name);
    if (value.starts_with('{') && value.ends_with('}')) {
      refuse(name, "a case that is an entry", "write its value");
    }
    for (std::uint32_t before = 1; before < number; ++before) {
      if (value_of(case_name(before)) != value) continue;
      refuse(name, "a case that is given twice", "remove it and its child, which is never chosen");
    }
    if (is_number() && is_in_upper_case(value)) {
      refuse(name, fmt::format("the name '{}' of a number", brief(value)),
             "write the number that a program registers for it");
    }
    return std::string(value);
  }

  std::string variable_of(std::string_view name) {
    const std::string_view on = value_of(name);
    if (is_entry_name(on)) return fmt::format("{{{}}}", on);
    const bool is_text =
        on.size() >= 2 && on.front() == '\'' && on.find('\'', 1) == on.size() - 1 && on[1] != '{';
    if (is_text) return std::string(on.substr(1, on.size() - 2));
    refuse(name, fmt::format("a Switch on the script '{}'", brief(on)),
           "only one on an entry can: let a Script before it write one");
    return {};
  }

  const Document& document_;
  std::uint32_t element_;
  std::optional<ValueType> type_;
  ConvertedSwitch result_;
};

}  // namespace

std::uint32_t switch_cases_there(std::string_view type) {
  if (type.size() != 7 || !type.starts_with("Switch")) return 0;
  const auto cases = static_cast<std::uint32_t>(type.back() - '0');
  return cases >= kFewest && cases <= kMost ? cases : 0;
}

bool is_switch_attribute(std::string_view name) {
  return name == "variable" || name == "on" || name == "cases" || name.starts_with("case_");
}

ConvertedSwitch switch_to_ours(const Document& document, std::uint32_t element, std::uint32_t cases,
                               std::optional<ValueType> type) {
  return Switch(document, element, type).to_ours(cases);
}

ConvertedSwitch switch_to_theirs(const Document& document, std::uint32_t element,
                                 std::uint32_t children, std::optional<ValueType> type) {
  return Switch(document, element, type).to_theirs(children);
}

}  // namespace lockstep::host
