// Reads what is expected of a scenario.
#pragma once

#include <cstdint>
#include <string>

#include "scenario/binding_reader.h"

namespace lockstep::host {

class ExpectationReader {
 public:
  // All must outlive this; numbers are read by `reader`.
  ExpectationReader(const Document& document, const std::string& file, const BindingReader& reader,
                    const Reporter& report)
      : document_(document), file_(file), reader_(reader), report_(report) {}

  void read(std::uint32_t element, Scenario& into) const;

 private:
  Expectation::Kind read(const Attribute& it, Expectation& expect) const;
  void read_ending(const Attribute& it, Expectation& expect) const;

  const Document& document_;
  const std::string& file_;
  const BindingReader& reader_;
  const Reporter& report_;
};

}  // namespace lockstep::host
