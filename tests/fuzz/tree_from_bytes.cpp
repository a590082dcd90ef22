#include "tree_from_bytes.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/node_kind.h"
#include "mock_leaf.h"

namespace lockstep::host::fuzz {
namespace {

constexpr int kMaxDepth = 10;
constexpr int kMaxTrees = 4;

// The text as an attribute value.
std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7f && std::string_view("&<\"").find(c) == text.npos;
    out += plain ? std::string(1, c) : fmt::format("&#{};", byte == 0 ? 1 : byte);
  }
  return out;
}

class Generator {
 public:
  explicit Generator(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::string file() {
    const int trees = 1 + below(kMaxTrees);
    std::string text = "<root lockstep=\"1\" main_tree_to_execute=\"T0\">\n";
    for (int tree = 0; tree < trees; ++tree) {
      text += fmt::format("<BehaviorTree ID=\"T{}\">", tree) + node(0) + "</BehaviorTree>\n";
    }
    return text + "</root>\n";
  }

 private:
  // 0 when the bytes are at their end.
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  int below(int end) { return byte() % end; }

  std::string node(int depth);
  std::string leaf();
  std::string attribute(const Parameter& parameter);
  std::string value(ValueType type);
  std::string garbage();

  std::span<const std::uint8_t> bytes_;
};

std::string Generator::node(int depth) {
  const auto kinds = built_in_kinds();
  const int choice = below(2 * static_cast<int>(kinds.size()));
  if (bytes_.empty() || depth == kMaxDepth) return leaf();
  if (choice >= static_cast<int>(kinds.size())) return leaf();
  const NodeType& type = kinds[static_cast<std::size_t>(choice)]->type;
  if (type.category == NodeCategory::SubTree) {
    return fmt::format("<SubTree ID=\"T{}\" name=\"s\"/>", below(kMaxTrees));
  }
  std::string text = fmt::format("<{}", type.id);
  for (const Parameter& parameter : type.parameters) text += attribute(parameter);
  text += ">";
  // Now and then as many children as it must not have.
  const int wanted = type.arity.max > 1 ? 1 + below(4) : below(16) == 15 ? below(3) : 1;
  const int children = type.arity.max == 0 ? 0 : wanted;
  for (int child = 0; child < children; ++child) text += node(depth + 1);
  return text + fmt::format("</{}>", type.id);
}

std::string Generator::leaf() {
  constexpr std::string_view kIds[] = {"Mock", "Mock", "MockCondition", "MockBare"};
  const auto id = kIds[below(4)];
  std::string script;
  for (int length = below(12); length > 0; --length) {
    script += kLetters[static_cast<std::size_t>(below(static_cast<int>(kLetters.size())))];
  }
  std::string text = fmt::format("<{} script=\"{}\"", id, script);
  if (below(4) == 3) text += " out=\"{k}\"";
  return text + "/>";
}

std::string Generator::attribute(const Parameter& parameter) {
  const int how = below(8);
  if (how < 4 && !parameter.required) return {};
  std::string text = value(parameter.type);
  if (!parameter.choices.empty()) {
    text = parameter.choices[static_cast<std::size_t>(how) % parameter.choices.size()];
  }
  if (how == 7) text = garbage();
  return fmt::format(" {}=\"{}\"", parameter.name, escape(text));
}

std::string Generator::value(ValueType type) {
  switch (type) {
    case ValueType::Bool:
      return below(2) == 1 ? "true" : "false";
    case ValueType::Int:
      return std::to_string(below(5));
    case ValueType::Number:
    case ValueType::Double:
      return fmt::format("{}", below(16) / 15.0);
    case ValueType::String:
      return garbage();
    default:
      break;
  }
  std::string list;
  int sum = 0;
  for (int length = below(5); length > 0; --length) {
    sum += below(8);
    list += fmt::format("{}{}", list.empty() ? "" : ";", sum / 16.0);
  }
  return list;
}

std::string Generator::garbage() {
  std::string text;
  for (int length = below(10); length > 0; --length) text += static_cast<char>(byte());
  return text;
}

}  // namespace

std::string tree_from_bytes(std::span<const std::uint8_t> bytes) {
  return Generator(bytes).file();
}

}  // namespace lockstep::host::fuzz
