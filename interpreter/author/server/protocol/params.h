// The params of the client's messages, as far as the server reads them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "author/server/positions.h"
#include "author/server/protocol/message.h"

namespace lockstep::host {

using PositionRange = std::pair<Position, Position>;

struct TextChange {
  std::optional<PositionRange> range;  // none: it is the whole text
  std::string text;
};

// Each method about a file sends some of these.
struct FileParams {
  std::string uri;
  std::int64_t version = 0;
  std::string text;
  std::vector<TextChange> changes;
  Position position;
  std::optional<PositionRange> range;
  std::string new_name;
  bool with_declaration = true;
  std::vector<std::string> kinds;  // of code actions that are asked for; none: all
  bool is_automatic = false;       // nobody has asked for code actions, the editor does
  bool insert_spaces = true;
  std::uint64_t tab_size = 2;
};
FileParams read_file_params(JsonReader& reader, Message& message);

// `initialize` and workspace/didChangeConfiguration send these; a member that is not there stays as
// it was.
struct ClientParams {
  std::string root;  // a path, or ""
  bool has_related_information = false;
  bool has_snippets = false;
  bool has_markdown = false;
  bool can_register_watchers = false;
  bool has_document_changes = false;  // edits for a version of a file
  std::optional<bool> trusted;
  std::optional<std::vector<std::string>> plugins, plugin_path;
  std::optional<std::vector<std::pair<std::string, std::string>>> arguments;
};
ClientParams read_client_params(JsonReader& reader, Message& message);
ClientParams read_configuration(JsonReader& reader, Message& message);

}  // namespace lockstep::host
