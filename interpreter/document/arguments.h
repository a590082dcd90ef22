// Load-time arguments: what <arg> elements declare, what --arg gives, and ${name} in attributes
// replaced by it. It sees one element at a time; which elements, in which order, is project.cpp's.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/project.h"

namespace lockstep {

// Of one attribute value after substitution, and of all of them together.
constexpr std::size_t kMaxValueMiB = 1;
constexpr std::size_t kMaxExpandedMiB = 64;

class ArgumentTable {
 public:
  ArgumentTable(const Arguments& given, Diagnostics& diagnostics)
      : given_(given), diagnostics_(diagnostics) {}

  // `element` is an <arg>. Its own attributes may use what is declared before it.
  void declare(Document& document, std::uint32_t element);
  // Replaces ${name} in every attribute of `element`. A value with an error stays as it is written;
  // false when there is one.
  bool substitute(Document& document, std::uint32_t element);
  // Reports what was given and is not declared.
  void check_given() const;
  std::vector<DeclaredArgument> take() { return std::move(declared_); }

 private:
  struct Where {
    std::size_t index;
    SourceLocation location;
    bool has_value;
  };

  std::optional<std::string> expand(const Document& document, std::uint32_t element,
                                    const Attribute& attribute);
  const Where* find(std::string_view name) const;
  bool fits(std::size_t bytes, const Document& document, std::uint32_t element,
            const Attribute& attribute);
  void report_unknown(std::string_view name, const Document& document, SourceLocation location);
  std::string list_declared(std::string_view near) const;

  const Arguments& given_;
  Diagnostics& diagnostics_;
  std::vector<DeclaredArgument> declared_;
  std::map<std::string, Where, std::less<>> by_name_;
  std::size_t expanded_ = 0;  // bytes of all substituted values
  bool is_full_ = false;      // there were too many
};

}  // namespace lockstep
