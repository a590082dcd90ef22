// BT::XMLParser of xml_parsing.h reads trees for a factory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

#if __has_include(<lockstep/runtime.h>)  // where a program can make trees
class Parser {
 public:
  Parser() = default;
  virtual ~Parser() = default;
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  Parser(Parser&&) = default;
  Parser& operator=(Parser&&) = default;

  virtual void loadFromFile(const std::filesystem::path& file, bool add_includes = true) = 0;
  virtual void loadFromText(const std::string& text, bool add_includes = true) = 0;
  [[nodiscard]] virtual std::vector<std::string> registeredBehaviorTrees() const = 0;
  [[nodiscard]] virtual Tree instantiateTree(const Blackboard::Ptr& root_blackboard,
                                             std::string tree_name = {}) = 0;
  virtual void clearInternalState() {}
};
#endif

}  // namespace BT
