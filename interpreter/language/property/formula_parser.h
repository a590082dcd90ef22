// The part of a property that speaks of one tick: arm.running and not {stop} == true.
#pragma once

#include <string_view>

#include "language/property/property.h"
#include "language/property/property_token.h"

namespace lockstep::host {

class FormulaParser {
 public:
  FormulaParser(std::string_view text, const PropertyNames& names, Formula& formula)
      : text_(text), names_(names), formula_(formula) {}

  // From the next token on, to the first that cannot be part of it. Throws a PropertyError.
  FormulaCode formula();

  // For the parser of what is around formulas.
  const PropertyToken& token();  // the next one
  bool take_word(std::string_view word);
  [[noreturn]] void expected(std::string_view what, std::string hint = {});
  PropertyToken take();

 private:
  using What = FormulaStep::What;

  void alternative(std::size_t depth);
  void conjunction(std::size_t depth);
  void negation(std::size_t depth);
  void primary(std::size_t depth);
  void node_term();
  void check_quotes(const PropertyToken& name) const;
  void field_of(std::uint32_t place, std::string_view field, std::size_t offset);
  void progress_of(std::uint32_t place);
  void entry_term();
  void entry_constant(EntryComparison& comparison, const PropertyToken& key);
  void add(What what, std::size_t place, unsigned statuses = 0);

  std::string_view text_;
  const PropertyNames& names_;
  Formula& formula_;
  FormulaCode code_;
  std::size_t offset_ = 0;
  bool has_token_ = false;
  PropertyToken token_;
};

}  // namespace lockstep::host
