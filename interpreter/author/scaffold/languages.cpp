#include "author/scaffold/languages.h"

#include <algorithm>

namespace lockstep::host {
namespace {

const std::vector<SourceLanguage>& rows() {
  using enum NewNodeKind;
  using enum ValueType;
  static const std::vector<SourceLanguage> all{
      {"cpp",
       "C++",
       ".cpp",
       "LOCKSTEP_PLUGIN(",
       {"Input", "Output", "InOut"},
       {},
       {},
       {{Number, "lockstep::Number"},
        {Bool, "bool"},
        {Int, "std::int64_t"},
        {Double, "double"},
        {String, "std::string"},
        {DoubleList, "std::vector<double>"},
        {IntList, "std::vector<std::int64_t>"},
        {BoolList, "std::vector<bool>"},
        {StringList, "std::vector<std::string>"}},
       {Action, Condition, Threaded, Control, Decorator}},
      {"c",
       "C",
       ".c",
       "lockstep_plugin_entry",
       {"LOCKSTEP_INPUT", "LOCKSTEP_OUTPUT", "LOCKSTEP_INOUT"},
       "above the list of types, with <stdlib.h> included",
       "into that list",
       {{Number, "LOCKSTEP_NUMBER"},
        {Bool, "LOCKSTEP_BOOL"},
        {Int, "LOCKSTEP_INT"},
        {Double, "LOCKSTEP_DOUBLE"},
        {String, "LOCKSTEP_STRING"},
        {DoubleList, "LOCKSTEP_DOUBLE_LIST"},
        {IntList, "LOCKSTEP_INT_LIST"},
        {BoolList, "LOCKSTEP_BOOL_LIST"},
        {StringList, "LOCKSTEP_STRING_LIST"}},
       {Action, Condition, Control, Decorator}},
      {"python",
       "Python",
       ".py",
       "lockstep_leaf",
       {"", "Output", "InOut"},
       {},
       {},
       {{Bool, "bool"},
        {Int, "int"},
        {Double, "float"},
        {String, "str"},
        {DoubleList, "list[float]"},
        {IntList, "list[int]"},
        {BoolList, "list[bool]"},
        {StringList, "list[str]"}},
       {Action, Condition}},
      {"rust",
       "Rust",
       ".rs",
       "lockstep_plugin_entry",
       {"input", "output", "inout"},
       "above #[no_mangle]",
       "into the list of Plugin::of(…)",
       {{Bool, "Bool"},
        {Int, "Int"},
        {Double, "Double"},
        {String, "String"},
        {DoubleList, "DoubleList"}},
       {Action, Condition}},
      {"btcpp",
       "C++ for BehaviorTree.CPP",
       ".cpp",
       "BT_REGISTER_NODES(",
       {"InputPort", "OutputPort", "BidirectionalPort"},
       "above BT_REGISTER_NODES",
       "into its braces",
       {{Bool, "bool"},
        {Int, "int"},
        {Double, "double"},
        {String, "std::string"},
        {DoubleList, "std::vector<double>"},
        {IntList, "std::vector<int>"},
        {StringList, "std::vector<std::string>"}},
       {Action, Condition, Control, Decorator}}};
  return all;
}

}  // namespace

std::string_view to_string(NewNodeKind kind) {
  static constexpr std::string_view kNames[] = {"action", "condition", "threaded", "control",
                                                "decorator"};
  return kNames[static_cast<int>(kind)];
}

bool is_python(const SourceLanguage& language) {
  return language.name == "python";
}

std::span<const SourceLanguage> source_languages() {
  return rows();
}

const SourceLanguage* find_language(std::string_view name) {
  const auto found = std::ranges::find(rows(), name == "c++" ? "cpp" : name, &SourceLanguage::name);
  return found == rows().end() ? nullptr : &*found;
}

}  // namespace lockstep::host
