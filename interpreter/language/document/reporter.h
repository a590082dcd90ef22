// Reports errors at places in the texts, with the source line. Used by all checks.
#pragma once

#include <string>

#include "base/core/diagnostics.h"
#include "language/document/sources.h"

namespace lockstep::host {

class Reporter {
 public:
  Reporter(const Sources& sources, Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics) {}

  const Sources& sources() const { return sources_; }
  bool has_errors() const { return diagnostics_.has_errors(); }

  // An error that is not kept needs neither a message nor a place: a document may have a million
  // errors. Returns true if the error was only counted.
  bool counted_only(Severity severity) const {
    if (!diagnostics_.is_full(severity)) return false;
    diagnostics_.count_one(severity);
    return true;
  }

  void at(MessageCode code, Place place, std::string message, std::string hint = {},
          Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    const Source& source = sources_.of(place);
    add(code, source, source.locate(place), std::move(message), std::move(hint), severity);
  }
  // At the value of the attribute that is at this place.
  void at_value(MessageCode code, Place attribute, std::string message, std::string hint = {},
                Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    const Source& source = sources_.of(attribute);
    add(code, source, source.locate_value(attribute), std::move(message), std::move(hint),
        severity);
  }
  // The same at a byte of the value, as it was read from the text.
  void in_value(MessageCode code, Place attribute, std::size_t byte, std::string message,
                std::string hint, Severity severity = Severity::Error) const {
    if (counted_only(severity)) return;
    const Source& source = sources_.of(attribute);
    add(code, source, source.locate_value(attribute, byte), std::move(message), std::move(hint),
        severity);
  }
  // Reports an error without a place in the texts, such as one in an option.
  void nowhere(MessageCode code, std::string message, std::string hint = {}) const {
    diagnostics_.error(code, {}, std::move(message), std::move(hint));
  }

 private:
  void add(MessageCode code, const Source& source, SourceLocation location, std::string message,
           std::string hint, Severity severity) const {
    Excerpt excerpt = source.excerpt(location.line, location.column);
    diagnostics_.add({severity, std::move(location), std::move(message), std::move(hint),
                      std::move(excerpt), code});
  }

  const Sources& sources_;
  Diagnostics& diagnostics_;
};

}  // namespace lockstep::host
