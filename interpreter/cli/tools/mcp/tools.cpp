#include "cli/tools/mcp/tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/system/replace_text.h"
#include "language/document/document.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;
using Kind = ToolInput::Kind;
using Gives = Tool::Gives;

constexpr ToolInput kTree{"tree", Kind::File, "", "The tree file, from the workspace on", "tree"};
constexpr ToolInput kText{"text", Kind::Text, "", "Or its content", "tree"};
constexpr ToolInput kLeaves{"leaves", Kind::File, "--leaves",
                            "A leaf model: what the leaves may do"};
constexpr ToolInput kLeavesText{"leaves_text", Kind::Content, "--leaves", "Or its content"};
constexpr ToolInput kRecording{"recording", Kind::Recording, "",
                               "A recording (default: that of the last simulation)"};
constexpr ToolInput kMock{
    "mock", Kind::Flag, "--mock",
    "Accept nodes that no plugin has: they are leaves, of which nothing is known"};
constexpr ToolInput kArguments{"arguments", Kind::Words, "--arg",
                               "Values of the arguments of the tree, each as name=value"};
constexpr ToolInput kMainTree{"main", Kind::Word, "--tree",
                              "The BehaviorTree to take (default: the one that the file names)"};

}  // namespace

std::span<const Tool> tools() {
  static const std::vector<Tool> kAll{
      {"nodes",
       "What trees are made of: each node with its ports, children and description, with those of "
       "the given plugins.",
       {"nodes", "--format=json"},
       {{"id", Kind::Word, "", "Only this node"}},
       "nodes",
       Gives::List},
      {"check",
       "Check a tree without running it. Each message has a stable code, its place in bytes, and "
       "edits that mend it, the best first; one that is certain can be applied without asking.",
       {"check", "--format=json"},
       {kTree,
        kText,
        {"strict", Kind::Flag, "--strict", "Treat warnings as errors, and nodes of no plugin"},
        kMock,
        kArguments},
       "messages",
       Gives::List},
      {"format",
       "Bring a tree, a scenario file or a leaf model into the canonical layout.",
       {"fmt"},
       {{"tree", Kind::FileText, "", "The file, from the workspace on", "tree"}, kText},
       "text",
       Gives::Text,
       false},
      {"show",
       "Draw a tree.",
       {"show"},
       {kTree,
        kText,
        {"format", Kind::Word, "--format", "text (the default), mermaid, or dot for Graphviz"},
        kMainTree,
        kArguments},
       "drawing",
       Gives::Text},
      {"test",
       "Play scenarios of trees without a robot, and compare with what they expect.",
       {"test", "--json", "--out={scratch}"},
       {{"paths", Kind::Files, "", "Files of scenarios, trees with scenarios, or folders", "paths"},
        {"text", Kind::Content, "", "Or a tree with scenarios in it", "paths"},
        {"filter", Kind::Words, "--filter", "Only scenarios whose names contain one of these"},
        {"mutate", Kind::Flag, "--mutate",
         "Then change the trees a little, and report the changes that no scenario notices"}},
       "results",
       Gives::Object},
      {"verify",
       "Search all behaviors of a tree: results that cannot occur, deadlocks, dead ends, "
       "properties "
       "that "
       "do not hold, each with a run that shows it. Without findings and limits, it is a proof "
       "under the assumptions that the verdict names.",
       {"verify", "--format=json", "--out={scratch}", "--time={time}", "--memory={memory}"},
       {kTree,
        kText,
        kLeaves,
        kLeavesText,
        {"properties", Kind::Words, "--property",
         "Properties that each run must have, such as 'grip: never grip.running and not arm.held'"},
        {"rate", Kind::Number, "--rate", "Ticks per second"},
        {"depth", Kind::Number, "--depth", "Search only the first ticks"},
        {"states", Kind::Number, "--states", "Stop after so many states"},
        kMock,
        kMainTree,
        kArguments},
       "verdict",
       Gives::Object},
      {"simulate",
       "Run a tree once on a virtual clock, as fast as the machine allows. Its leaves are those of "
       "the leaf model; without one, each answers by chance what its contract allows. No leaf of a "
       "plugin runs. The run is recorded for measure, why and scenario_from.",
       {"run", "--clock=virtual", "--json", "--view=none", "--record={recording}"},
       {kTree,
        kText,
        kLeaves,
        kLeavesText,
        {"seed", Kind::Number, "--seed", "By which the answers are chosen"},
        {"rate", Kind::Number, "--rate", "Ticks per second"},
        {"seconds", Kind::Number, "--timeout", "Stop after so many seconds of the run"},
        {"max_ticks", Kind::Number, "--max-ticks", "Stop after so many ticks (default: 100000)"},
        {"properties", Kind::Words, "--property", "Properties to watch"},
        {"values", Kind::Words, "--set", "Start values of entries, each as key=value"},
        kMainTree,
        kArguments},
       "summary",
       Gives::Object},
      {"measure",
       "Measure a recording: how well parallel nodes kept step, how long nodes took.",
       {"log", "measure", "--json"},
       {kRecording,
        {"measures", Kind::Words, "--measure",
         "Such as factor:NODE (default: progress-distance, step-length, duration)"}},
       "measures",
       Gives::List,
       false},
      {"why",
       "Why a node of a recording failed, waits or never ran.",
       {"log", "why", "--json"},
       {kRecording,
        {"node", Kind::Word, "", "Its path or the end of it (default: the root)"},
        {"at", Kind::Number, "--at", "As of this tick (default: the last)"}},
       "reasons",
       Gives::Object,
       false},
      {"diff",
       "What differs between two trees in meaning, not in layout.",
       {"diff", "--format=json"},
       {{"before", Kind::File, "", "The old tree file", "before"},
        {"before_text", Kind::Content, "", "Or its content", "before"},
        {"after", Kind::File, "", "The new tree file", "after"},
        {"after_text", Kind::Content, "", "Or its content", "after"}},
       "changes",
       Gives::Object},
      {"scenario_from",
       "A scenario for the tool test that does what a recording did.",
       {"log", "scenario"},
       {kRecording,
        {"tree", Kind::File, "", "The tree file (default: as the recording names it)"},
        {"text", Kind::Content, "", "Or its content"},
        {"name", Kind::Word, "--name", "The name of the scenario"}},
       "scenario",
       Gives::Text},
  };
  return kAll;
}

namespace {

Json type_of(Kind kind) {
  switch (kind) {
    case Kind::Number:
      return {{"type", "number"}};
    case Kind::Flag:
      return {{"type", "boolean"}};
    case Kind::Files:
    case Kind::Words:
      return {{"type", "array"}, {"items", Json{{"type", "string"}}}};
    default:
      return {{"type", "string"}};
  }
}

Json result_type(Gives gives) {
  if (gives == Gives::Text) return {{"type", "string"}};
  if (gives == Gives::Object) return {{"type", "object"}};
  return {{"type", "array"}, {"items", Json{{"type", "object"}}}};
}

// Builds the command line of one call.
class CommandBuilder {
 public:
  CommandBuilder(const Tool& tool, const ToolValues& values, const ToolFolders& folders,
                 const fs::path& call)
      : tool_(tool), values_(values), folders_(folders), call_(call) {}

  Result<ToolCommand> build() {
    for (const std::string_view word : tool_.words) command_.words.push_back(filled(word));
    if (tool_.takes_plugins) {
      std::ranges::copy(folders_.plugin_words, std::back_inserter(command_.words));
    }
    if (auto done = check_names(); !done) return tl::unexpected(done.error());
    for (const ToolInput& it : tool_.inputs) {
      const auto value = values_.find(it.name);
      if (value == values_.end()) {
        if (it.kind == Kind::Recording) command_.words.push_back(folders_.recording());
        continue;
      }
      if (auto done = add(it, value->second); !done) return tl::unexpected(done.error());
    }
    if (auto done = check_slots(); !done) return tl::unexpected(done.error());
    if (tool_.name == "simulate") {
      if (auto done = add_safeguards(); !done) return tl::unexpected(done.error());
    }
    std::ranges::move(places_, std::back_inserter(command_.words));
    return std::move(command_);
  }

 private:
  // No leaf of a plugin runs, and the run ends.
  Result<void> add_safeguards() {
    if (!values_.contains("max_ticks")) command_.words.emplace_back("--max-ticks=100000");
    if (values_.contains("leaves") || values_.contains("leaves_text")) return {};
    return add_text(kLeavesText, "<leaves lockstep=\"1\"/>\n");
  }

  std::string filled(std::string_view word) const {
    const auto begin = word.find('{');
    if (begin == word.npos) return std::string(word);
    const std::string_view name = word.substr(begin);
    return fmt::format("{}{}", word.substr(0, begin),
                       name == "{scratch}"     ? call_.string()
                       : name == "{recording}" ? folders_.recording()
                       : name == "{time}"      ? fmt::format("{:.3f}", folders_.seconds * 0.8)
                                               : fmt::format("{}", folders_.memory_mib / 2));
  }

  Result<void> check_names() const {
    for (const auto& [name, value] : values_) {
      if (std::ranges::find(tool_.inputs, name, &ToolInput::name) != tool_.inputs.end()) continue;
      std::vector<std::string_view> known;
      for (const ToolInput& it : tool_.inputs) known.push_back(it.name);
      return problem(fmt::format("'{}' has no argument '{}'", tool_.name, brief(name)),
                     suggest(name, known, "its arguments"));
    }
    return {};
  }

  Result<void> check_slots() const {
    std::set<std::string_view> slots;
    for (const ToolInput& it : tool_.inputs)
      if (!it.slot.empty()) slots.insert(it.slot);
    for (const std::string_view slot : slots) {
      std::vector<std::string_view> names;
      int given = 0;
      for (const ToolInput& it : tool_.inputs) {
        if (it.slot != slot) continue;
        names.push_back(it.name);
        given += values_.contains(it.name) ? 1 : 0;
      }
      if (given == 1) continue;
      return problem(fmt::format("'{}' needs {} of {}", tool_.name, given == 0 ? "one" : "only one",
                                 listed(names)));
    }
    return {};
  }

  Result<void> add(const ToolInput& input, const ToolValue& value) {
    if (input.kind == Kind::Flag) {
      const bool* const flag = std::get_if<bool>(&value);
      if (flag == nullptr) return wrong(input, "true or false");
      if (*flag) command_.words.emplace_back(input.option);
      return {};
    }
    if (input.kind == Kind::Number) {
      const ToolNumber* const number = std::get_if<ToolNumber>(&value);
      return number == nullptr ? wrong(input, "a number") : put(input, number->text);
    }
    if (input.kind == Kind::Files || input.kind == Kind::Words) {
      const auto* const list = std::get_if<std::vector<std::string>>(&value);
      if (list == nullptr) return wrong(input, "a list of strings");
      if (list->empty() && !input.slot.empty()) return wrong(input, "a list that is not empty");
      for (const std::string& it : *list)
        if (auto done = add_text(input, it); !done) return done;
      return {};
    }
    const auto* const text = std::get_if<std::string>(&value);
    return text == nullptr ? wrong(input, "a string") : add_text(input, *text);
  }

  // A text in place of a file, or a file in place of a text.
  Result<void> check_meaning(const ToolInput& input, const std::string& text) const {
    const bool is_file = is_of_file(input.kind), is_text = is_of_text(input.kind);
    const bool has_content = text.find_first_of("<\n") != text.npos || text.starts_with('{');
    const bool has_name = !has_content && text.ends_with(".xml");
    if (!(is_file && has_content) && !(is_text && has_name)) return {};
    const auto other = std::ranges::find_if(tool_.inputs, [&](const ToolInput& it) {
      return input.kind != Kind::Recording && it.kind != Kind::Recording && it.slot == input.slot &&
             it.option == input.option && (is_file ? is_of_text(it.kind) : is_of_file(it.kind));
    });
    return problem(fmt::format("'{}' of '{}' is {}, and got {}", input.name, tool_.name,
                               is_file ? "the name of a file" : "the content of a file",
                               is_file ? "a text" : fmt::format("the name '{}'", brief(text))),
                   other != tool_.inputs.end() ? fmt::format("give it as '{}'", other->name)
                                               : "write it to a file of the workspace");
  }
  static bool is_of_file(Kind kind) {
    return kind == Kind::File || kind == Kind::Files || kind == Kind::FileText ||
           kind == Kind::Recording;
  }
  static bool is_of_text(Kind kind) { return kind == Kind::Text || kind == Kind::Content; }

  Result<void> add_text(const ToolInput& input, const std::string& text) {
    if (text.find('\0') != text.npos) return wrong(input, "a string without the character 0");
    if (auto done = check_meaning(input, text); !done) return done;
    switch (input.kind) {
      case Kind::Text:
        command_.input = text;
        return put(input, "-");
      case Kind::Content: {
        const fs::path file =
            call_ /
            fmt::format("{}{}", input.name, input.option == "--leaves" ? ".leaves.xml" : ".xml");
        if (auto done = create_text(file.string(), text, 0600); !done) return done;
        return put(input, file.string());
      }
      case Kind::FileText: {
        auto file = in_workspace(text);
        if (!file) return tl::unexpected(file.error());
        auto content = read_file(*file, Document::kMaxBytes);
        if (!content)
          return problem(
              fmt::format("'{}' cannot be read: {}", brief(text), content.error().message));
        command_.input = std::move(*content);
        return put(input, "-");
      }
      case Kind::File:
      case Kind::Files:
      case Kind::Recording: {
        auto file = in_workspace(text);
        return file ? put(input, std::move(*file)) : tl::unexpected(file.error());
      }
      default:
        if (input.option.empty() && text.starts_with('-'))
          return problem(fmt::format("'{}' begins with '-'", brief(text)));
        return put(input, text);
    }
  }

  Result<void> put(const ToolInput& input, std::string value) {
    if (input.option.empty()) {
      places_.push_back(std::move(value));
    } else {
      command_.words.push_back(fmt::format("{}={}", input.option, value));
    }
    return {};
  }

  // Relative to the workspace, in which the commands run.
  Result<std::string> in_workspace(const std::string& path) const {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(folders_.workspace / path, error);
    const fs::path inside = whole.lexically_relative(folders_.workspace);
    if (error || inside.empty() || *inside.begin() == "..")
      return problem(fmt::format("'{}' is outside of the workspace {}", brief(path),
                                 folders_.workspace.string()),
                     "tools read only files in it");
    return "./" + inside.string();
  }

  tl::unexpected<Problem> wrong(const ToolInput& input, std::string_view expected) const {
    return problem(fmt::format("'{}' of '{}' must be {}", input.name, tool_.name, expected));
  }

  const Tool& tool_;
  const ToolValues& values_;
  const ToolFolders& folders_;
  const fs::path& call_;
  ToolCommand command_;
  std::vector<std::string> places_;  // words that are no options
};

}  // namespace

Json json_of(const Tool& tool) {
  Json inputs = Json::object();
  for (const ToolInput& it : tool.inputs) {
    Json schema = type_of(it.kind);
    schema.add("description", it.doc);
    inputs.add(std::string(it.name), std::move(schema));
  }
  Json result = Json::object();
  result.add("exit_code", Json{{"type", "integer"}, {"description", "as docs/cli.md lists them"}});
  result.add("log", Json{{"type", "string"}, {"description", "messages for people"}});
  result.add(std::string(tool.result), result_type(tool.gives));
  std::vector<std::string> needed{"exit_code", "log", std::string(tool.result)};
  Json annotations{{"readOnlyHint", true}, {"openWorldHint", false}};
  return {{"name", tool.name},
          {"description", tool.doc},
          {"inputSchema", Json{{"type", "object"},
                               {"properties", std::move(inputs)},
                               {"additionalProperties", false}}},
          {"outputSchema",
           Json{{"type", "object"}, {"properties", std::move(result)}, {"required", needed}}},
          {"annotations", std::move(annotations)}};
}

Result<ToolCommand> command_of(const Tool& tool, const ToolValues& values,
                               const ToolFolders& folders, const fs::path& call) {
  return CommandBuilder(tool, values, folders, call).build();
}

}  // namespace lockstep::host
