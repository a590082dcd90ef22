// A text in JSON as values: as much as the values of ports need.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace BT::detail {

struct JsonNode {
  enum class Kind { Null, Bool, Number, Text, List, Object };
  Kind kind = Kind::Null;
  bool flag = false;
  std::string text;             // of a number: as it is written
  std::vector<JsonNode> items;  // of a list or an object
  std::vector<std::string> names;

  const JsonNode* find(std::string_view name) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) return &items[i];
    }
    return nullptr;
  }
};

class JsonParser {
 public:
  // False: it is no JSON.
  static bool parse(std::string_view text, JsonNode& node) {
    JsonParser parser(text);
    return parser.value(node, 0) && (parser.blanks(), parser.text_.empty());
  }

 private:
  static constexpr int kMostLevels = 100;
  explicit JsonParser(std::string_view text) : text_(text) {}

  void blanks() { text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size())); }
  bool take(char c) {
    blanks();
    const bool is_there = !text_.empty() && text_.front() == c;
    if (is_there) text_.remove_prefix(1);
    return is_there;
  }
  bool take_word(std::string_view word) {
    const bool is_there = text_.substr(0, word.size()) == word;
    if (is_there) text_.remove_prefix(word.size());
    return is_there;
  }

  bool value(JsonNode& node, int level) {
    if (level > kMostLevels) return false;
    if (take('{')) return items(node, JsonNode::Kind::Object, '}', level);
    if (take('[')) return items(node, JsonNode::Kind::List, ']', level);
    if (take('"')) {
      node.kind = JsonNode::Kind::Text;
      return rest_of_text(node.text);
    }
    node.kind = JsonNode::Kind::Bool;
    if (take_word("true")) return node.flag = true;
    if (take_word("false")) return true;
    node.kind = JsonNode::Kind::Null;
    return take_word("null") || number(node);
  }

  bool number(JsonNode& node) {
    node.kind = JsonNode::Kind::Number;
    const std::size_t end = std::min(text_.find_first_not_of("+-.0123456789eE"), text_.size());
    node.text = text_.substr(0, end);
    text_.remove_prefix(end);
    return end != 0;
  }

  bool items(JsonNode& node, JsonNode::Kind kind, char end, int level) {
    node.kind = kind;
    if (take(end)) return true;
    do {
      if (kind == JsonNode::Kind::Object) {
        std::string& name = node.names.emplace_back();
        if (!take('"') || !rest_of_text(name) || !take(':')) return false;
      }
      if (!value(node.items.emplace_back(), level + 1)) return false;
    } while (take(','));
    return take(end);
  }

  bool rest_of_text(std::string& out) {
    while (!text_.empty()) {
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == '"') return true;
      if (c != '\\') {
        out += c;
      } else if (!escape(out)) {
        return false;
      }
    }
    return false;
  }
  bool escape(std::string& out) {
    if (text_.empty()) return false;
    constexpr std::string_view kFrom = "\"\\/bfnrt", kTo = "\"\\/\b\f\n\r\t";
    const char c = text_.front();
    text_.remove_prefix(1);
    if (c == 'u') return code_point(out);
    const std::size_t which = kFrom.find(c);
    if (which != std::string_view::npos) out += kTo[which];
    return which != std::string_view::npos;
  }
  // Of the first plane only.
  bool code_point(std::string& out) {
    unsigned code = 0;
    if (text_.size() < 4) return false;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + 4, code, 16);
    if (error != std::errc() || end != text_.data() + 4) return false;
    text_.remove_prefix(4);
    const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xc0 | code >> 6);
      put(0x80 | (code & 0x3f));
    } else {
      put(0xe0 | code >> 12);
      put(0x80 | (code >> 6 & 0x3f));
      put(0x80 | (code & 0x3f));
    }
    return true;
  }

  std::string_view text_;
};

inline void write_json_text(std::string_view text, std::string& out) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned char>(c));
      out += code;
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace BT::detail
