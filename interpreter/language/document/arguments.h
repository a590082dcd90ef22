// Load-time arguments: <arg> elements declare them, --arg sets them, and they replace ${name} in
// attributes. This class handles one element at a time; project.cpp decides which elements, and in
// which order.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/document/project.h"
#include "language/document/reporter.h"

namespace lockstep::host {

// The largest attribute value after substitution, and all of them together.
constexpr std::size_t kMaxValueMiB = 1;
constexpr std::size_t kMaxExpandedMiB = 64;

class ArgumentTable {
 public:
  // `report` is for the texts that elements are in.
  ArgumentTable(const Arguments& given, const Reporter& report) : given_(given), report_(report) {}
  void set_rules(const LanguageRules& rules) { rules_ = &rules; }

  // `element` is an <arg>. Its attributes may use arguments that are declared before it.
  void declare(Document& document, std::uint32_t element);
  // Replaces ${name} in every attribute of `element`. A value with an error is left as written;
  // then this returns false.
  bool substitute(Document& document, std::uint32_t element);
  // Reports arguments that were given but are not declared.
  void check_given() const;
  std::vector<DeclaredArgument> take() { return std::move(declared_); }

 private:
  struct Where {
    std::size_t index;
    Place place;  // of the attribute that names it
    bool has_value;
  };

  std::optional<std::string> expand(const Attribute& attribute);
  const Where* find(std::string_view name) const;
  // Whether the "${" at that byte of `text` is only text.
  bool is_text(std::string_view text, std::size_t at) const;
  bool fits(std::size_t bytes, const Attribute& attribute);
  std::string list_declared(std::string_view near) const;

  const Arguments& given_;
  Reporter report_;
  const LanguageRules* rules_ = &kLockstepRules;
  std::vector<DeclaredArgument> declared_;
  std::map<std::string, Where, std::less<>> by_name_;
  std::size_t expanded_ = 0;  // bytes of all substituted values
  bool is_full_ = false;      // there were too many
};

}  // namespace lockstep::host
