// Reports errors at places in one document, with the source line. For all who check what it says.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "document/document.h"

namespace lockstep {

class Reporter {
 public:
  Reporter(const Document& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics) {}

  bool has_errors() const { return diagnostics_.has_errors(); }

  // What is not kept needs neither words nor a place: a document may have a million errors. True
  // when it is counted and done with.
  bool counted_only(Severity severity) const {
    if (!diagnostics_.is_full(severity)) return false;
    diagnostics_.count_one(severity);
    return true;
  }

  void at_element(std::uint32_t element, std::string message, std::string hint = {},
                  Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    at(document_.locate(element), std::move(message), std::move(hint), severity);
  }
  void at_attribute(std::uint32_t element, std::string_view name, std::string message,
                    std::string hint = {}, Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    at(document_.locate_attribute(element, name), std::move(message), std::move(hint), severity);
  }
  void at_value(std::uint32_t element, std::string_view name, std::string message,
                std::string hint = {}, Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    at(document_.locate_value(element, name), std::move(message), std::move(hint), severity);
  }

  void at(SourceLocation location, std::string message, std::string hint = {},
          Severity severity = Severity::Error) const {
    std::string excerpt = document_.excerpt(location);
    diagnostics_.add(
        {severity, std::move(location), std::move(message), std::move(hint), std::move(excerpt)});
  }

 private:
  const Document& document_;
  Diagnostics& diagnostics_;
};

}  // namespace lockstep
