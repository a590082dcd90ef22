// The part of the server that follows the texts of the files, and tells what is wrong with them.
#include <filesystem>
#include <set>
#include <utility>

#include "author/server/server.h"

namespace lockstep::host {
namespace {

// A relative name is of the workspace, not of the directory in which the editor was started.
std::string in_root(const std::string& root, const std::string& path) {
  return (std::filesystem::path(root) / path).lexically_normal().string();
}

}  // namespace

void Server::use(const ClientParams& client) {
  Settings settings = *settings_;
  if (client.trusted) settings.trusted = *client.trusted;
  if (client.plugins) {
    settings.plugins.plugins = own_.plugins.plugins;
    for (const std::string& it : *client.plugins)
      settings.plugins.plugins.push_back(is_plugin_file(it) ? in_root(client_.root, it) : it);
  }
  if (client.plugin_path) {
    settings.plugins.directories = own_.plugins.directories;
    for (const std::string& it : *client.plugin_path)
      settings.plugins.directories.push_back(in_root(client_.root, it));
  }
  if (client.arguments) {
    settings.arguments = own_.arguments;
    for (const auto& [name, value] : *client.arguments) settings.arguments[name] = value;
  }
  settings_ = std::make_shared<const Settings>(std::move(settings));
}

void Server::open(Message& message) {
  FileParams params = read_file_params(connection_.reader(), message);
  workspace_.open(params.uri, std::move(params.text), params.version);
  workspace_.mark_dirty(*workspace_.find(params.uri));
}

void Server::change(Message& message) {
  const FileParams params = read_file_params(connection_.reader(), message);
  OpenFile* const file = workspace_.find(params.uri);
  if (file == nullptr) throw JsonError("the file is not open");
  file->change(params.changes);
  file->version = params.version;
  workspace_.mark_dirty(*file);
}

void Server::close(Message& message) {
  const FileParams params = read_file_params(connection_.reader(), message);
  analyses_.forget(params.uri);
  // What includes it reads the saved text again.
  if (const OpenFile* file = workspace_.find(params.uri)) workspace_.mark_dirty(*file);
  workspace_.close(params.uri);
  found_.erase(params.uri);
  publish(params.uri, Tell::Always);
  ask_again();  // for those that wait for what is found in it, nothing will be
}

void Server::look_again(Message&) {
  workspace_.mark_all_dirty();
}

void Server::configure(Message& message) {
  use(read_configuration(connection_.reader(), message));
  workspace_.mark_all_dirty();
}

void Server::post_jobs() {
  UnsavedTexts texts;
  for (auto& [uri, file] : workspace_.files()) {
    if (!std::exchange(file.is_dirty, false)) continue;
    if (texts.empty()) texts = workspace_.texts();
    file.serial = ++serial_;
    analyses_.post(
        {uri, file.path, file.shared_bytes(), file.version, file.serial, texts, settings_});
  }
}

void Server::take_analyses() {
  bool is_news = false;
  for (Analysis& it : analyses_.take()) {
    OpenFile* const file = workspace_.find(it.uri);
    if (file == nullptr || it.serial > file->serial) continue;
    const std::string uri = it.uri;
    file->analysis = std::make_shared<const Analysis>(std::move(it));
    is_news = true;
    if (file->analysis->left_plugins_out) say_untrusted();
    if (file->analysis->version != file->version) continue;
    DiagnosticsByUri found =
        diagnostics_of(*file->analysis, workspace_, client_.has_related_information);
    const bool is_new = std::exchange(file->told, file->version) != file->version;
    std::swap(found_[uri], found);
    publish(uri, is_new ? Tell::Always : Tell::Changes);
  }
  if (is_news) ask_again();
}

// Messages of several files may be about one that they include.
void Server::publish(const std::string& checked, Tell tell) {
  std::map<std::string, std::vector<Json>> all;
  for (const auto& [uri, text] : published_) all[uri];
  all[checked];
  for (const auto& [main, found] : found_) {
    for (const auto& [uri, messages] : found) {
      auto& of_uri = all[uri];
      of_uri.insert(of_uri.end(), messages.begin(), messages.end());
    }
  }
  for (auto& [uri, messages] : all) {
    std::set<std::string> seen;
    std::erase_if(messages, [&](const Json& it) { return !seen.insert(it.text()).second; });
    Json params{{"uri", uri}};
    const OpenFile* const file = workspace_.find(uri);
    if (file != nullptr && uri == checked) params["version"] = file->version;
    params["diagnostics"] = Json::array(std::move(messages));
    std::string text = params["diagnostics"].text();
    std::string& before = published_[uri];
    if (before == text && (uri != checked || tell == Tell::Changes)) continue;
    before = std::move(text);
    connection_.send(notification("textDocument/publishDiagnostics", std::move(params)));
  }
  std::erase_if(published_, [&](const auto& it) {
    return it.second == "[]" && workspace_.find(it.first) == nullptr;
  });
}

void Server::say_untrusted() {
  if (std::exchange(said_untrusted_, true)) return;
  Json params{{"type", 3},
              {"message",
               "lockstep: no plugin is loaded, since this workspace is not trusted. The nodes of "
               "plugins are not checked."}};
  connection_.send(notification("window/showMessage", std::move(params)));
}

}  // namespace lockstep::host
