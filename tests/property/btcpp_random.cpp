#include "property/btcpp_random.h"

#include <fmt/format.h>

#include <random>
#include <span>

namespace lockstep::host::test::law {

// n and m are numbers, t and u are texts; they are not mixed.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  Document document() {
    Document document;
    Element main{.tag = "Sequence"};
    const Script start[] = {{"n", ":=", "", 0.0},
                            {"m", ":=", "", 1.0},
                            {"i", ":=", "", 1.0},
                            {"t", ":=", "", "x"},
                            {"u", ":=", "", "y"}};
    for (const Script& it : start) {
      if (below(10) != 0) main.children.push_back(script(it));
    }
    has_subtrees_ = true;
    main.children.push_back(node(1 + below(4)));
    document["Main"] = below(4) == 0 ? std::move(main.children.back()) : std::move(main);
    has_subtrees_ = false;
    document["Sub"] = node(1 + below(3));
    return document;
  }

 private:
  int below(int end) { return static_cast<int>(random_() % static_cast<std::uint64_t>(end)); }
  std::string one_of(std::span<const char* const> all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  template <std::size_t kSize>
  std::string one_of(const char* const (&all)[kSize]) {
    return one_of(std::span<const char* const>(all));
  }
  std::string number_key() { return one_of({"n", "m", "n", "m", "@n", "i"}); }
  std::string text_key() { return one_of({"t", "u", "t", "@t"}); }

  static Element script(Script code) {
    return {.tag = "Script", .scripts = {{"code", std::move(code)}}};
  }

  Script condition() {
    const int kind = below(8);
    if (kind == 0) return {.value = static_cast<double>(below(2))};
    if (kind == 1) return {text_key(), one_of({"==", "!="}), "", one_of({"x", "y"})};
    Script it{number_key(), one_of({"==", "!=", "<", ">"}), "", static_cast<double>(below(4))};
    if (kind == 2) it.other = number_key();
    return it;
  }
  Script assignment() {
    const int kind = below(8);
    if (kind == 0) return {text_key(), ":=", "", one_of({"x", "y"})};
    Script it{number_key(), one_of({":=", "=", "+=", "+="}), "", static_cast<double>(below(3))};
    if (kind == 1) it.other = number_key();
    return it;
  }

  void add_scripts(Element& element) {
    constexpr const char* kBefore[] = {"_failureIf", "_successIf", "_skipIf", "_while"};
    constexpr const char* kAfter[] = {"_onSuccess", "_onFailure", "_post", "_onHalted"};
    if (below(5) == 0) element.scripts[one_of(kBefore)] = condition();
    if (below(12) == 0) element.scripts[one_of(kBefore)] = condition();
    if (below(5) == 0) element.scripts[one_of(kAfter)] = assignment();
    if (below(12) == 0) element.scripts[one_of(kAfter)] = assignment();
  }

  Element node(int depth) {
    Element element = depth <= 0 || below(6) == 0 ? leaf() : inner(depth);
    add_scripts(element);
    return element;
  }

  std::string letters(const char* from) {
    const std::string_view all = from;
    std::string text;
    for (int length = 1 + below(4); length > 0; --length) {
      text += all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
      if (text.back() == 'R' && below(2) == 0) text += one_of({".2", ".5", ".75", ".9"});
    }
    return text;
  }

  Element leaf() {
    switch (below(has_subtrees_ ? 13 : 11)) {
      case 0:
      case 1:
        return named({.tag = "Cond", .letters = letters("SSFFK")});
      case 2:
        return script(assignment());
      case 3:
        return {.tag = "ScriptCondition", .scripts = {{"code", condition()}}};
      case 4:
        return {.tag = one_of({"AlwaysSuccess", "AlwaysFailure"})};
      case 5:
        return {.tag = "Sleep", .attributes = {{"msec", one_of({"0", "100", "250"})}}};
      case 6:
        return {.tag = "SetBlackboard",
                .attributes = {{"value", one_of({"x", "y", "{t}", "{u}"})},
                               {"output_key", text_key()}}};
      case 7:
        if (below(2) == 0) {
          return {.tag = "UnsetBlackboard", .attributes = {{"key", one_of({"n", "t", "@n", "u"})}}};
        }
        return {.tag = "WasEntryUpdated",
                .attributes = {{"entry", one_of({"{n}", "m", "{t}", "{i}"})}}};
      case 11:
      case 12:
        return subtree();
      default:
        return named({.tag = "Act", .letters = letters("RRRSSSFFK")});
    }
  }

  // What has progress for a while.
  Element motion() { return named({.tag = "Act", .letters = letters("RRRR") + letters("RRS")}); }

  Element named(Element leaf) {
    leaf.attributes["name"] = fmt::format("a{}", ++names_);
    return leaf;
  }

  Element subtree() {
    Element it{.tag = "SubTree", .attributes = {{"ID", "Sub"}}};
    it.attributes["name"] = fmt::format("s{}", ++names_);
    for (const char* key : {"n", "m", "i"}) {
      const int how = below(6);
      if (how == 0 || how > 3) it.attributes[key] = "{=}";
      if (how == 1) it.attributes[key] = "{" + std::string(one_of({"n", "m", "@n"})) + "}";
      if (how == 2) it.attributes[key] = one_of({"0", "2"});
    }
    if (below(3) == 0) it.attributes["t"] = one_of({"{u}", "{=}", "x"});
    if (below(2) == 0) it.attributes["_autoremap"] = "true";
    return it;
  }

  Element inner(int depth) {
    constexpr const char* kOrdered[] = {"Sequence",           "Fallback",      "ReactiveSequence",
                                        "ReactiveFallback",   "AsyncSequence", "AsyncFallback",
                                        "SequenceWithMemory", "Parallel",      "ParallelAll"};
    constexpr const char* kDecorators[] = {"Inverter", "ForceSuccess", "ForceFailure",
                                           "KeepRunningUntilFailure"};
    Element it;
    int least = 1, most = 1;
    switch (below(15)) {
      case 12:
      case 13:
      case 14:
        it = synchronized();
        most = 4;
        break;
      case 0:
        it = {.tag = one_of({"IfThenElse", "WhileDoElse"})};
        least = 2, most = 3;
        break;
      case 1:
        it = {.tag = "TryCatch", .attributes = {{"catch_on_halt", one_of({"true", "false"})}}};
        least = 2, most = 4;
        break;
      case 2:
        it = {.tag = "Switch2",
              .attributes = {{"variable", "{t}"}, {"case_1", "x"}, {"case_2", "y"}}};
        least = most = 3;
        break;
      case 3:
        it = {.tag = one_of(kDecorators)};
        break;
      case 4:
      case 5:
        it = decorator();
        break;
      default:
        it = {.tag = one_of(kOrdered)};
        most = 4;
        break;
    }
    const bool compares = it.tag == "ParallelAbsolute" || it.tag == "ParallelRelative";
    for (int i = least + below(most - least + 1); i > 0; --i) {
      it.children.push_back(compares && below(3) == 0 ? motion() : node(depth - 1));
    }
    add_counts(it);
    return it;
  }

  Element synchronized() {
    if (below(2) == 0) {
      return {.tag = "ParallelRelative", .attributes = {{"delta", one_of({"0", "0.2", "0.5"})}}};
    }
    Element it{.tag = "ParallelAbsolute"};
    it.attributes["barriers"] = one_of({"0.5", "0.2;0.6", "0.25;0.5;0.75;1"});
    if (below(3) == 0) it.attributes["at_barrier"] = "tick";
    return it;
  }

  void add_counts(Element& it) {
    const int all = static_cast<int>(it.children.size());
    if (it.tag == "ParallelAbsolute" || it.tag == "ParallelRelative") {
      const auto some = [&] { return std::to_string(1 + below(all)); };
      if (below(3) == 0) it.attributes["success_count"] = some();
      if (below(3) == 0) it.attributes["failure_count"] = some();
      if (all == 3) it.attributes["hold"] = "between";
      return;
    }
    const auto count = [&] { return std::to_string(below(all + 3) - 2); };
    if (it.tag == "ParallelAll" && below(2) == 0) it.attributes["max_failures"] = count();
    if (it.tag != "Parallel") return;
    if (below(3) != 0) it.attributes["success_count"] = count();
    if (below(3) != 0) it.attributes["failure_count"] = count();
  }

  Element decorator() {
    const auto rounds = [&] { return std::string(one_of({"0", "1", "2", "3", "{n}"})); };
    switch (below(9)) {
      case 0:
        return {.tag = "Repeat", .attributes = {{"num_cycles", rounds()}}};
      case 1:
        return {.tag = "RetryUntilSuccessful", .attributes = {{"num_attempts", rounds()}}};
      case 2:
        return {.tag = "RunOnce", .attributes = {{"then_skip", one_of({"true", "false"})}}};
      case 3:
        return {.tag = "Delay", .attributes = {{"delay_msec", one_of({"0", "100", "250"})}}};
      case 4:
        return {.tag = "Timeout", .attributes = {{"msec", one_of({"0", "100", "250"})}}};
      case 5:
        return {.tag = "Precondition",
                .attributes = {{"else", one_of({"FAILURE", "SUCCESS", "SKIPPED", "RUNNING"})}},
                .scripts = {{"if", condition()}}};
      case 6:
        return {.tag = "LoopInt",
                .attributes = {{"queue", "1;2;3"},
                               {"value", "{i}"},
                               {"if_empty", one_of({"SUCCESS", "FAILURE", "SKIPPED"})}}};
      default:
        return {.tag = one_of({"SkipUnlessUpdated", "WaitValueUpdate"}),
                .attributes = {{"entry", one_of({"{n}", "m", "{t}", "i"})}}};
    }
  }

  std::mt19937_64 random_;
  bool has_subtrees_ = false;
  int names_ = 0;
};

namespace {

std::string shown(const Script& script) {
  const auto* text = std::get_if<std::string>(&script.value);
  const std::string value = !script.other.empty() ? script.other
                            : text != nullptr
                                ? "'" + *text + "'"
                                : fmt::format("{:.0f}", std::get<double>(script.value));
  return script.name.empty() ? value : script.name + " " + script.op + " " + value;
}

std::string escaped(const std::string& value) {
  std::string out;
  for (const char c : value) c == '<' ? out += "&lt;" : out += c;
  return out;
}

void append(const Element& element, std::string& out) {
  out += "<" + element.tag;
  for (const auto& [name, value] : element.attributes)
    out += fmt::format(" {}=\"{}\"", name, value);
  for (const auto& [name, script] : element.scripts) {
    out += fmt::format(" {}=\"{}\"", name, escaped(shown(script)));
  }
  out += ">";
  for (const Element& child : element.children) append(child, out);
  out += "</" + element.tag + ">";
}

void append_leaves(const Element& element, std::string& out) {
  if (!element.letters.empty()) {
    out += fmt::format("{}={} ", element.attributes.at("name"), element.letters);
  }
  for (const Element& child : element.children) append_leaves(child, out);
}

}  // namespace

Document random_document(std::uint64_t seed) {
  return Generator(seed).document();
}

std::string to_xml(const Document& document) {
  std::string text = "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">";
  for (const auto& [id, tree] : document) {
    text += "\n<BehaviorTree ID=\"" + id + "\">";
    append(tree, text);
    text += "</BehaviorTree>";
  }
  return text + "\n</root>\n";
}

std::string leaves_text(const Document& document) {
  std::string text;
  for (const auto& [id, tree] : document) append_leaves(tree, text);
  return text;
}

}  // namespace lockstep::host::test::law
