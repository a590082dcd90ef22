// The tools of `lockstep mcp`: each is a command of lockstep, with a schema of what it takes and of
// what it gives.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/core/problem.h"
#include "base/json/json.h"

namespace lockstep::host {

struct ToolInput {
  enum class Kind : unsigned char {
    File,       // a path in the workspace
    Files,      // several
    Text,       // the content of a file, for stdin
    Content,    // the content of a file, for a file in the scratch folder
    FileText,   // a path in the workspace, of which stdin has the content
    Recording,  // a path in the workspace; default: the last simulation
    Word,
    Words,
    Number,
    Flag,
  };
  std::string_view name;
  Kind kind;
  std::string_view option;  // "": it has a place of its own
  std::string_view doc;
  // Of the inputs with this name, one must be given; "": it may be left out.
  std::string_view slot = {};
};

struct Tool {
  std::string_view name, doc;
  std::vector<std::string_view> words;  // of the command line
  std::vector<ToolInput> inputs;
  std::string_view result;  // how its result is called
  enum class Gives : unsigned char { Object, List, Text } gives;
  bool takes_plugins = true;
};

std::span<const Tool> tools();
// As `tools/list` has it.
Json json_of(const Tool& tool);

// As the command line takes it: a seed has more digits than a double.
struct ToolNumber {
  std::string text;
};
using ToolValue = std::variant<std::string, ToolNumber, bool, std::vector<std::string>>;
using ToolValues = std::map<std::string, ToolValue, std::less<>>;

// Where the calls of a server find and leave files.
struct ToolFolders {
  std::filesystem::path workspace;  // canonical
  std::filesystem::path scratch;
  std::vector<std::string> plugin_words = {};  // of each command that takes plugins
  double seconds = 60;                         // the limits of a call
  std::size_t memory_mib = 4096;

  std::string recording() const { return (scratch / "last.jsonl").string(); }
};

struct ToolCommand {
  std::vector<std::string> words;
  std::string input;
};
// Writes the contents that are given into the folder of this call in the scratch folder.
Result<ToolCommand> command_of(const Tool& tool, const ToolValues& values,
                               const ToolFolders& folders, const std::filesystem::path& call);

}  // namespace lockstep::host
