// All node types, by id: the built-in ones and the leaves of plugins.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/core/node_type.h"
#include "language/expression/script_enums.h"

namespace lockstep::host {

class Catalog {
 public:
  // The types must outlive the catalog; ids are distinct.
  void add(const NodeType* type);
  // Instead of the one with its id, if there is one.
  void replace(const NodeType* type);

  // Words that scripts know as numbers.
  void set_words(ScriptEnums words) {
    if (!words.empty()) words_ = std::make_shared<const ScriptEnums>(std::move(words));
  }
  const std::shared_ptr<const ScriptEnums>& words() const { return words_; }  // null: none

  const NodeType* find(std::string_view id) const;
  std::vector<std::string_view> ids() const;                         // sorted
  std::span<const NodeType* const> types() const { return types_; }  // as added

 private:
  std::vector<const NodeType*> types_;
  std::unordered_map<std::string_view, const NodeType*> by_id_;
  std::shared_ptr<const ScriptEnums> words_;
};

}  // namespace lockstep::host
