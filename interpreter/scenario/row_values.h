// The rows of a scenario: <row name="value"/>, whose values stand for ${name} in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "language/document/reporter.h"

namespace lockstep::host {

class RowValues {
 public:
  // All must outlive this. Reports what is wrong with the rows, and names that they do not have.
  RowValues(Document& document, std::uint32_t scenario, const Reporter& report);

  bool are_good() const { return are_good_; }
  // At least 1: without rows there is one, which is empty.
  std::size_t count() const { return rows_.empty() ? 1 : rows_.size(); }
  // Puts its values into the attributes of the scenario.
  void choose(std::size_t row);
  // "barriers=0.5, ticks=3"; "" without rows.
  std::string text(std::size_t row) const;

 private:
  struct Written {
    const Attribute* attribute;
    std::string value;
  };
  struct Row {
    std::uint32_t element;
  };

  std::string replaced(const Written& written, std::size_t row);

  Document& document_;
  const Reporter& report_;
  std::vector<Row> rows_;
  std::vector<Written> written_;  // attributes with ${…} in them
  bool are_good_ = true;
};

}  // namespace lockstep::host
