// JSON that configures something: read without a library of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"

namespace BT::lockstep_detail {

struct PlainJson {
  enum class Kind { kObject, kList, kText, kNumber, kWord };
  Kind kind = Kind::kWord;
  std::vector<std::pair<std::string, PlainJson>> members;  // of a list without names
  std::string value;                                       // a text, a number, true, false or null

  const PlainJson* find(StringView name) const {
    for (const auto& [member, it] : members) {
      if (member == name) return &it;
    }
    return nullptr;
  }
  // "" or 0 where there is none; throws when it is something else.
  std::string text(StringView name) const { return value_of(name, Kind::kText, "a text"); }
  double number(StringView name) const {
    const std::string text = value_of(name, Kind::kNumber, "a number");
    return text.empty() ? 0 : std::stod(text);
  }

  // Throws RuntimeError, with the line.
  static PlainJson read(StringView text);

 private:
  std::string value_of(StringView name, Kind wanted, const char* what) const {
    const PlainJson* const found = find(name);
    if (found == nullptr) return {};
    if (found->kind != wanted) throw RuntimeError("'", name, "' in the JSON must be ", what);
    return found->value;
  }
};

class JsonReader {
 public:
  explicit JsonReader(StringView text) : text_(text) {}

  PlainJson document() {
    PlainJson it = value(0);
    skip();
    if (at_ < text_.size()) fail("there is something after its end");
    return it;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    std::size_t line = 1;
    for (const char c : text_.substr(0, at_)) line += c == '\n' ? 1 : 0;
    throw RuntimeError("the JSON, line ", std::to_string(line), ": ", what);
  }
  void skip() {
    while (at_ < text_.size() && StringView(" \t\r\n").find(text_[at_]) != StringView::npos) ++at_;
  }
  bool takes(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!takes(c)) fail(StrCat("'", std::string(1, c), "' is missing"));
  }

  PlainJson value(int depth) {
    if (depth > 64) fail("it is nested too deeply");
    PlainJson it;
    if (takes('{')) {
      it.kind = PlainJson::Kind::kObject;
      read_members(it, '}', depth);
    } else if (takes('[')) {
      it.kind = PlainJson::Kind::kList;
      read_members(it, ']', depth);
    } else if (takes('"')) {
      it.kind = PlainJson::Kind::kText;
      it.value = rest_of_text();
    } else {
      read_word(it);
    }
    return it;
  }
  void read_members(PlainJson& it, char end, int depth) {
    if (takes(end)) return;
    do {
      std::string name;
      if (end == '}') {
        need('"');
        name = rest_of_text();
        need(':');
      }
      it.members.emplace_back(std::move(name), value(depth + 1));
    } while (takes(','));
    need(end);
  }
  void read_word(PlainJson& it) {
    while (at_ < text_.size() && StringView(" \t\r\n,]}:").find(text_[at_]) == StringView::npos) {
      it.value += text_[at_++];
    }
    if (it.value == "true" || it.value == "false" || it.value == "null") return;
    it.kind = PlainJson::Kind::kNumber;
    char* end = nullptr;
    std::strtod(it.value.c_str(), &end);
    if (it.value.empty() || *end != '\0') fail(StrCat("'", it.value, "' is no value"));
  }
  std::string rest_of_text() {
    std::string text;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] != '\\') {
        text += text_[at_];
      } else if (++at_ < text_.size()) {
        add_escaped(text);
      }
    }
    if (at_ >= text_.size()) fail("a text does not end");
    ++at_;
    return text;
  }
  void add_escaped(std::string& text) {
    constexpr StringView kNames = "nrtbf\"\\/";
    constexpr StringView kMeaning = "\n\r\t\b\f\"\\/";
    if (const auto found = kNames.find(text_[at_]); found != StringView::npos) {
      text += kMeaning[found];
    } else {
      fail("such an escaped character is not read here; write it as UTF-8");
    }
  }

  StringView text_;
  std::size_t at_ = 0;
};

inline PlainJson PlainJson::read(StringView text) {
  return JsonReader(text).document();
}

}  // namespace BT::lockstep_detail
