// Reads what the leaves of a scenario do, and the numbers of scenarios.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "language/document/document.h"
#include "language/document/reporter.h"
#include "scenario/scenario.h"

namespace lockstep::host {

// `name`, as it is found from the directory of `file`.
std::string beside(const std::string& file, std::string_view name);

// As many words as ticks: running with a progress that rises in equal steps, then the result of the
// row. A leaf that is to run for ever has one.
void add_even_words(BindingRow& row, std::uint64_t ticks);

class BindingReader {
 public:
  // All must outlive this.
  BindingReader(const Document& document, const std::string& file, const Reporter& report)
      : document_(document), file_(file), report_(report) {}

  void read_leaf(std::uint32_t element, Scenario& into) const;

  // A text that is no number is reported, and the least is returned.
  std::uint64_t count(const Attribute& it, std::uint64_t least) const;
  double number(const Attribute& it, double least, double most) const;
  NumberRange range(const Attribute& it, std::string_view as) const;

 private:
  void read_words(const Attribute& it, BindingRow& row) const;
  void read_source(const Attribute& it, BindingRow& row) const;
  void make_words(std::uint32_t element, BindingRow& row) const;

  const Document& document_;
  const std::string& file_;
  const Reporter& report_;
};

}  // namespace lockstep::host
