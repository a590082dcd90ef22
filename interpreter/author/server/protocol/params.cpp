#include "author/server/protocol/params.h"

#include "author/server/uri.h"

namespace lockstep::host {
namespace {

// Reads those fields that are there; null is as if nothing were there.
void read_some(JsonValue value, std::vector<JsonField> fields) {
  if (value.is_null()) return;
  for (JsonField& field : fields) field.may_lack = true;
  value.object().read(fields);
}

// null, or another type than expected, is as if it were not there.
template <class T>
auto maybe(T& to) {
  return [&to](JsonValue value) {
    if (!value.get(to)) value.skip();
  };
}
auto maybe_text(std::string& to) {
  return [&to](JsonValue value) {
    std::string_view text;
    value.get(text) ? void(to = text) : value.skip();
  };
}

Position position_in(JsonValue value) {
  Position position;
  value.object().read({{"line", into(position.line)}, {"character", into(position.character)}});
  return position;
}

PositionRange range_in(JsonValue value) {
  PositionRange range;
  value.object().read({{"start", [&](JsonValue it) { range.first = position_in(it); }},
                       {"end", [&](JsonValue it) { range.second = position_in(it); }}});
  return range;
}

void read_changes(JsonValue value, FileParams& to) {
  value.each_item([&](JsonValue item) {
    TextChange& change = to.changes.emplace_back();
    item.object().read({{"text", into(change.text)},
                        {"range", [&](JsonValue it) { change.range = range_in(it); }, kMayLack}});
  });
}

void read_contents(JsonValue value, bool& has_markdown) {
  value.each_item([&](JsonValue item) { has_markdown |= item.text() == "markdown"; });
}

void read_completion(JsonValue value, ClientParams& to) {
  read_some(value, {{"completionItem", [&](JsonValue item) {
                       read_some(item, {{"snippetSupport", maybe(to.has_snippets)}});
                     }}});
}

void read_text_capabilities(JsonValue value, ClientParams& to) {
  read_some(value, {{"publishDiagnostics",
                     [&](JsonValue it) {
                       read_some(it, {{"relatedInformation", maybe(to.has_related_information)}});
                     }},
                    {"completion", [&](JsonValue it) { read_completion(it, to); }},
                    {"hover", [&](JsonValue it) {
                       read_some(it, {{"contentFormat", [&](JsonValue formats) {
                                         read_contents(formats, to.has_markdown);
                                       }}});
                     }}});
}

void read_workspace_capabilities(JsonValue value, ClientParams& to) {
  const auto watched = [&](JsonValue it) {
    read_some(it, {{"dynamicRegistration", maybe(to.can_register_watchers)}});
  };
  const auto edits = [&](JsonValue it) {
    read_some(it, {{"documentChanges", maybe(to.has_document_changes)}});
  };
  read_some(value, {{"didChangeWatchedFiles", watched}, {"workspaceEdit", edits}});
}

void read_capabilities(JsonValue value, ClientParams& to) {
  read_some(value, {{"textDocument", [&](JsonValue it) { read_text_capabilities(it, to); }},
                    {"workspace", [&](JsonValue it) { read_workspace_capabilities(it, to); }}});
}

std::vector<std::string> texts_in(JsonValue value) {
  std::vector<std::string> texts;
  value.each_item([&](JsonValue item) { texts.emplace_back(item.text()); });
  return texts;
}

void read_settings(JsonValue value, ClientParams& to) {
  const auto read_arguments = [&](JsonValue it) {
    auto& arguments = to.arguments.emplace();
    it.object().each_field(
        [&](std::string_view name, JsonValue text) { arguments.emplace_back(name, text.text()); });
  };
  const auto read_trusted = [&](JsonValue it) {
    if (!it.get(to.trusted.emplace())) throw JsonError("'trusted' is neither true nor false");
  };
  read_some(value, {{"trusted", read_trusted},
                    {"plugins", [&](JsonValue it) { to.plugins = texts_in(it); }},
                    {"pluginPath", [&](JsonValue it) { to.plugin_path = texts_in(it); }},
                    {"arguments", read_arguments}});
}

// CodeActionTriggerKind
constexpr std::uint64_t kAutomatic = 2;

void set_root(JsonValue value, std::string& root) {
  std::string_view uri;
  value.get(uri) ? void(root = path_of_uri(uri)) : value.skip();
}

}  // namespace

FileParams read_file_params(JsonReader& reader, Message& message) {
  FileParams to;
  const auto document = [&](JsonValue value) {
    read_some(value,
              {{"uri", into(to.uri)}, {"version", maybe(to.version)}, {"text", into(to.text)}});
  };
  const auto context = [&](JsonValue value) {
    std::uint64_t trigger = 0;
    read_some(value, {{"includeDeclaration", maybe(to.with_declaration)},
                      {"only", [&](JsonValue it) { to.kinds = texts_in(it); }},
                      {"triggerKind", maybe(trigger)}});
    to.is_automatic = trigger == kAutomatic;
  };
  const auto options = [&](JsonValue value) {
    read_some(value, {{"insertSpaces", maybe(to.insert_spaces)}, {"tabSize", maybe(to.tab_size)}});
  };
  read_params(reader, message, [&](JsonObject params) {
    params.read({{"textDocument", document},
                 {"contentChanges", [&](JsonValue it) { read_changes(it, to); }, kMayLack},
                 {"position", [&](JsonValue it) { to.position = position_in(it); }, kMayLack},
                 {"range", [&](JsonValue it) { to.range = range_in(it); }, kMayLack},
                 {"newName", into(to.new_name), kMayLack},
                 {"context", context, kMayLack},
                 {"options", options, kMayLack}});
  });
  return to;
}

ClientParams read_client_params(JsonReader& reader, Message& message) {
  ClientParams to;
  std::string root_path;
  read_params(reader, message, [&](JsonObject params) {
    params.read(
        {{"rootUri", [&](JsonValue it) { set_root(it, to.root); }, kMayLack},
         {"rootPath", maybe_text(root_path), kMayLack},
         {"capabilities", [&](JsonValue it) { read_capabilities(it, to); }, kMayLack},
         {"initializationOptions", [&](JsonValue it) { read_settings(it, to); }, kMayLack}});
  });
  if (to.root.empty()) to.root = root_path;
  return to;
}

ClientParams read_configuration(JsonReader& reader, Message& message) {
  ClientParams to;
  const auto settings = [&](JsonValue value) {
    read_some(value, {{"lockstep", [&](JsonValue it) { read_settings(it, to); }}});
  };
  read_params(reader, message, [&](JsonObject params) {
    params.read({{"settings", settings, kMayLack}});
  });
  return to;
}

}  // namespace lockstep::host
