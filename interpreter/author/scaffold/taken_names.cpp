#include "author/scaffold/taken_names.h"

#include <algorithm>
#include <array>

namespace lockstep::host {
namespace {

// Of C++17, with those of C++20, of the technical specifications, and in place of signs.
constexpr auto kCppWords = std::to_array<std::string_view>({
    "alignas",       "alignof",     "and",
    "and_eq",        "asm",         "auto",
    "bitand",        "bitor",       "bool",
    "break",         "case",        "catch",
    "char",          "char16_t",    "char32_t",
    "char8_t",       "class",       "co_await",
    "co_return",     "co_yield",    "compl",
    "concept",       "const",       "const_cast",
    "consteval",     "constexpr",   "constinit",
    "continue",      "decltype",    "default",
    "delete",        "do",          "double",
    "dynamic_cast",  "else",        "enum",
    "explicit",      "export",      "extern",
    "false",         "float",       "for",
    "friend",        "goto",        "if",
    "inline",        "int",         "long",
    "mutable",       "namespace",   "new",
    "noexcept",      "not",         "not_eq",
    "nullptr",       "operator",    "or",
    "or_eq",         "private",     "protected",
    "public",        "register",    "reinterpret_cast",
    "requires",      "return",      "short",
    "signed",        "sizeof",      "static",
    "static_assert", "static_cast", "struct",
    "switch",        "template",    "this",
    "thread_local",  "throw",       "true",
    "try",           "typedef",     "typeid",
    "typename",      "union",       "unsigned",
    "using",         "virtual",     "void",
    "volatile",      "wchar_t",     "while",
    "xor",           "xor_eq",
});

// Macros that compilers and the headers of a source have.
constexpr auto kMacros = std::to_array<std::string_view>(
    {"EOF", "HUGE_VAL", "INFINITY", "NAN", "NULL", "errno", "i386", "linux", "typeof", "unix"});

// Members of the classes that ports and leaves derive from, and of the leaves that are made.
constexpr auto kMembers = std::to_array<std::string_view>({
    "Fixed",
    "InOut",
    "Input",
    "Output",
    "PortsType",
    "Status",
    "at_least",
    "at_most",
    "before_destroy",
    "before_start",
    "begin",
    "behavior",
    "between",
    "check",
    "child_count",
    "child_progress",
    "child_status",
    "context",
    "creator",
    "describe",
    "finish",
    "halt",
    "halt_child",
    "host",
    "host_extension",
    "kDuration",
    "kInfinity",
    "kKeepsProgress",
    "kMaxChildren",
    "kMinChildren",
    "kRealTime",
    "kWakes",
    "keeps_progress",
    "kept_progress",
    "log",
    "more_ports",
    "now",
    "optional",
    "pause",
    "pause_child",
    "progress",
    "random",
    "random_bits",
    "required",
    "resume",
    "run",
    "set_progress",
    "start",
    "tick",
    "tick_child",
    "tick_number",
    "tick_period",
    "uniform",
    "wake",
});

constexpr auto kPythonWords = std::to_array<std::string_view>(
    {"False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
     "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
     "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
     "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield"});

// What leaves have beside ports, and the words by which a class declares its ports.
constexpr auto kAttributes = std::to_array<std::string_view>(
    {"InOut",  "Output", "behavior", "bool",     "clock",      "describe",  "float",
     "halt",   "int",    "list",     "log",      "more_ports", "name",      "now",
     "path",   "pause",  "period",   "progress", "random",     "real_time", "restore",
     "resume", "save",   "set_pace", "start",    "str",        "tick"});

bool has(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

bool is_taken_in_cpp(std::string_view name) {
  // The members of the base classes that are private end with '_'.
  return name.ends_with('_') || has(kCppWords, name) || has(kMacros, name) || has(kMembers, name);
}

bool is_taken_in_python(std::string_view name) {
  return has(kPythonWords, name) || has(kAttributes, name);
}

}  // namespace lockstep::host
