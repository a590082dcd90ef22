#include "tree/check/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "tree/check/document_order.h"

namespace lockstep::host {
namespace {

struct CppType {
  std::string_view name;
  ValueType type;
};

// Without blanks, and lists without their allocator.
constexpr CppType kCppTypes[] = {
    {"double", ValueType::Double},
    {"float", ValueType::Double},
    {"int", ValueType::Int},
    {"unsignedint", ValueType::Int},
    {"long", ValueType::Int},
    {"unsignedlong", ValueType::Int},
    {"size_t", ValueType::Int},
    {"std::size_t", ValueType::Int},
    {"int8_t", ValueType::Int},
    {"int16_t", ValueType::Int},
    {"int32_t", ValueType::Int},
    {"int64_t", ValueType::Int},
    {"uint8_t", ValueType::Int},
    {"uint16_t", ValueType::Int},
    {"uint32_t", ValueType::Int},
    {"uint64_t", ValueType::Int},
    {"bool", ValueType::Bool},
    {"std::string", ValueType::String},
    {"string", ValueType::String},
    {"std::vector<double>", ValueType::DoubleList},
    {"std::vector<int>", ValueType::IntList},
    {"std::vector<int64_t>", ValueType::IntList},
    {"std::vector<bool>", ValueType::BoolList},
    {"std::vector<std::string>", ValueType::StringList},
};

std::string plain(std::string_view name) {
  std::string text;
  std::ranges::copy_if(name, std::back_inserter(text), [](char c) { return c != ' '; });
  if (text.starts_with("std::vector<")) {
    if (const auto comma = text.find(",std::allocator<"); comma != std::string::npos) {
      text = text.substr(0, comma) + ">";
    }
  }
  return text;
}

std::optional<Direction> direction_of(std::string_view tag) {
  if (tag == "input_port") return Direction::Input;
  if (tag == "output_port") return Direction::Output;
  if (tag == "inout_port") return Direction::InOut;
  return std::nullopt;
}

std::optional<NodeCategory> category_of(std::string_view tag) {
  if (tag == "Action") return NodeCategory::Action;
  if (tag == "Condition") return NodeCategory::Condition;
  if (tag == "Control") return NodeCategory::Control;
  if (tag == "Decorator") return NodeCategory::Decorator;
  if (tag == "SubTree" || tag == "SubTreePlus") return NodeCategory::SubTree;
  return std::nullopt;
}

class ModelReader {
 public:
  ModelReader(const Document& document, const Reporter& report, Models& models)
      : document_(document), report_(report), models_(models) {}

  void read() {
    bool is_first = true;
    for (const std::uint32_t child : children_in(elements_, 0)) {
      if (element(child).tag != "TreeNodesModel") continue;
      if (is_first) {
        read_all(child);
      } else {
        report_.at("bad-model"_code, element(child).place, "a second 'TreeNodesModel'",
                   "a file has at most one");
      }
      is_first = false;
    }
  }

 private:
  const Element& element(std::uint32_t index) const { return elements_[index]; }

  void read_all(std::uint32_t models) {
    for (const std::uint32_t child : children_in(elements_, models)) {
      const auto category = category_of(element(child).tag);
      const Attribute* id = document_.find_attribute(child, "ID");
      if (!category || id == nullptr || id->value.empty()) {
        if (report_.counted_only(Severity::Warning)) continue;
        report_.at("bad-model"_code, element(child).place,
                   category ? "a model without 'ID' is ignored"
                            : fmt::format("'{}' is not a model", brief(element(child).tag)),
                   "models: Action, Condition, Control, Decorator and SubTree", Severity::Warning);
        continue;
      }
      auto& all = *category == NodeCategory::SubTree ? models_.subtrees : models_.nodes;
      all[id->value] = {*category, ports(child, *category == NodeCategory::SubTree)};
    }
  }

  // The attributes of a SubTree must have the names as they are written.
  std::vector<ModelPort> ports(std::uint32_t model, bool is_subtree) const {
    std::vector<ModelPort> ports;
    for (const std::uint32_t child : children_in(elements_, model)) {
      const auto direction = direction_of(element(child).tag);
      const Attribute* name = document_.find_attribute(child, "name");
      if (!direction || name == nullptr) continue;
      const std::string_view plain = without_blanks_around(name->value);
      if (!is_subtree && plain != name->value) {
        report_.at_value("whitespace"_code, name->place,
                         fmt::format("there is whitespace around the port '{}'", brief(plain)),
                         fmt::format("it is read as name=\"{}\"", brief(plain)), Severity::Warning);
      }
      if (plain.empty()) continue;
      ModelPort port{.name = is_subtree ? name->value : plain,
                     .type = {},
                     .default_value = {},
                     .direction = *direction};
      if (const auto* type = document_.find_attribute(child, "type")) port.type = type->value;
      if (const auto* value = document_.find_attribute(child, "default")) {
        port.default_value = value->value;
      }
      ports.push_back(port);
    }
    return ports;
  }

  const Document& document_;
  std::span<const Element> elements_ = document_.elements();
  const Reporter& report_;
  Models& models_;
};

}  // namespace

Models read_models(const Project& project, const Reporter& report) {
  Models models;
  for (const std::uint32_t document : document_order(project)) {
    ModelReader(*project.documents[document], report, models).read();
  }
  return models;
}

std::optional<ValueType> type_of_cpp(std::string_view name) {
  const auto* const found = std::ranges::find(kCppTypes, plain(name), &CppType::name);
  return found == std::end(kCppTypes) ? std::nullopt : std::optional(found->type);
}

std::string_view cpp_type_of(ValueType type) {
  const auto* const found = std::ranges::find(kCppTypes, type, &CppType::type);
  return found == std::end(kCppTypes) ? std::string_view("BT::AnyTypeAllowed") : found->name;
}

}  // namespace lockstep::host
