// A script as statements. Here they are one: what stands between the semicolons runs together.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "behaviortree_cpp/scripting/script_parser.hpp"

namespace BT {
namespace Ast {

class ExprBase {
 public:
  using Ptr = std::shared_ptr<ExprBase>;
  virtual ~ExprBase() = default;
  // The value of the last one.
  virtual Any evaluate(Environment& environment) const = 0;
};

}  // namespace Ast

namespace Scripting {

// Throws when the text is no script.
inline std::vector<Ast::ExprBase::Ptr> parseStatements(const std::string& text) {
  class Statements final : public Ast::ExprBase {
   public:
    explicit Statements(const std::string& script) : script_(script) {}
    Any evaluate(Ast::Environment& environment) const override { return script_.run(environment); }

   private:
    mutable lockstep_detail::Script script_;
  };
  if (text.find_first_not_of(" \t\r\n;") == std::string::npos) return {};
  return {std::make_shared<Statements>(text)};
}

}  // namespace Scripting
}  // namespace BT
