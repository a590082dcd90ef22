#include "run/loading/plugin_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/core/wording.h"
#include "base/system/call_mark.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/initialize.h"
#include "leaves/plugin/open/plugin_path.h"
#include "leaves/plugin/open/shared_object.h"
#include "leaves/plugin/open/trust.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "leaves/remote/json_lines/program_plugin.h"
#include "leaves/remote/shared_memory/isolated_plugin.h"

namespace lockstep::host {
namespace {

// `refusal` continues "plugin 'x.so' ".
bool refuse(const std::string& origin, Problem refusal, Diagnostics& diagnostics,
            SourceLocation where) {
  diagnostics.error("plugin-refused"_code, std::move(where),
                    fmt::format("plugin '{}' {}", brief(origin), refusal.message),
                    std::move(refusal.hint));
  return false;
}

std::optional<Problem> check_expected_name(std::string_view name, std::string_view expected) {
  if (expected.empty() || name == expected) return std::nullopt;
  return Problem{fmt::format("calls itself '{}', expected '{}'", name, expected),
                 fmt::format("name the file '{}.so', or give the plugin the file's name", name)};
}

bool is_program(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  return name.find(".so") == name.npos && is_executable(path);
}

auto constant_of(const std::string& file) {
  return open_shared_object(file).and_then(
      [](const SharedObject& object) { return find_constant(object, LOCKSTEP_PLUGIN_ENTRY); });
}

// Why a leaf cannot run in a separate process. The message says what is wrong with its plugin.
std::optional<Problem> refuse_isolation(const Descriptors::Leaf& leaf) {
  if ((leaf.type.flags & LOCKSTEP_OPENS) != 0) {
    return Problem{
        fmt::format("cannot be isolated: '{}' uses entries by their names", leaf.type.id),
        "load it without isolation, or give it ports for them"};
  }
  for (const Parameter& port : leaf.parameters) {
    if (port.object == nullptr || port.object->has_bytes()) continue;
    return Problem{fmt::format("cannot be isolated: the port '{}' of '{}' carries objects, and the "
                               "type '{}' has no to_bytes and from_bytes",
                               port.name, leaf.type.id, port.object->name()),
                   "load it without isolation, or give the type both functions"};
  }
  // The children of a control node are leaves of other processes, or of this one.
  if (leaf.type.kind != LOCKSTEP_CONTROL && leaf.type.kind != LOCKSTEP_DECORATOR) {
    return std::nullopt;
  }
  return Problem{fmt::format("cannot be isolated: '{}' is a {}", leaf.type.id,
                             leaf.type.kind == LOCKSTEP_CONTROL ? "control node" : "decorator"),
                 "load it without isolation, or move its leaves into another plugin"};
}

// Two names of one file.
bool is_same_file(const std::string& one, const std::string& other) {
  std::error_code error;
  return std::filesystem::equivalent(one, other, error);
}

}  // namespace

struct PluginSet::Plugin {
  const lockstep_plugin* entry;  // the plugin's own constant
  std::string origin;
  std::unique_ptr<RemotePlugin> remote = {};  // null: it lives in this process
  Descriptors descriptors = {};
  bool initialized = false;

  std::string_view name() const { return descriptors.plugin.name; }
  // What the constant points to is the plugin's memory, and so is a crash.
  std::optional<Problem> read(std::size_t exported_size) {
    std::optional<MarkedCall> mark;
    if (remote == nullptr) mark.emplace(CallSite::of_plugin(origin), PluginFunction::Load);
    return read_descriptors(*entry, exported_size, descriptors);
  }
  std::string initialize() const {
    return remote != nullptr ? remote->initialize() : initialize_plugin(descriptors.plugin);
  }

  // Refuses isolation when none of the leaves can be isolated.
  std::optional<Problem> check_isolation() {
    std::optional<Problem> first;
    std::size_t refused = 0;
    for (const auto& leaf : descriptors.leaves) {
      auto refusal = refuse_isolation(*leaf);
      refused += refusal.has_value();
      if (!first) first = std::move(refusal);
    }
    descriptors.plugin.is_local = refused > 0;
    const bool is_hopeless = remote != nullptr && refused == descriptors.leaves.size();
    return is_hopeless ? std::move(first) : std::nullopt;
  }

  // The reason why two plugins cannot live in one set.
  static std::optional<Problem> check_against(const Plugin& newcomer, const Plugin& other);
};

std::optional<Problem> PluginSet::Plugin::check_against(const Plugin& newcomer,
                                                        const Plugin& other) {
  if (newcomer.name() == other.name()) {
    return Problem{fmt::format("is named '{}', as is '{}'", newcomer.name(), other.origin),
                   "load one of the two"};
  }
  for (const auto& leaf : newcomer.descriptors.leaves) {
    for (const auto& known : other.descriptors.leaves) {
      if (leaf->node_type.id != known->node_type.id) continue;
      return Problem{fmt::format("has the leaf '{}', which plugin '{}' has already",
                                 leaf->node_type.id, other.origin),
                     "load one of the two, or rename the leaf"};
    }
  }
  return std::nullopt;
}

PluginSet::PluginSet() = default;

PluginSet::~PluginSet() {
  for (auto plugin = plugins_.rbegin(); plugin != plugins_.rend(); ++plugin) {
    if ((*plugin)->remote != nullptr) {
      (*plugin)->remote.reset();
    } else if ((*plugin)->initialized) {
      deinitialize_plugin((*plugin)->descriptors.plugin);
    }
  }
}

void PluginSet::set_isolation(IsolationOptions options) {
  isolation_ = std::move(options);
}

bool PluginSet::load_file(const std::string& path, Diagnostics& diagnostics, SourceLocation where,
                          Isolation isolation) {
  if (is_program(path)) {
    const std::string name = std::filesystem::path(path).stem().string();
    return open_program({path, name, std::move(where)}, Hold::AsItSays, diagnostics);
  }
  return open({path, {}, std::move(where), isolation}, diagnostics);
}

bool PluginSet::load_named(std::string_view name, std::span<const std::string> directories,
                           Diagnostics& diagnostics, SourceLocation where, Isolation isolation) {
  if (!is_plugin_name(name)) {
    diagnostics.error("bad-name"_code, std::move(where),
                      fmt::format("'{}' is not the name of a plugin", brief(name)),
                      "a plugin is named by letters, digits, '_' and '-', without path and '.so'");
    return false;
  }
  if (has(name)) return true;
  warn_of_writable_directories(directories, where, diagnostics);
  auto path = find_plugin_file(name, directories);
  if (!path) {
    return refuse(std::string(name), std::move(path.error()), diagnostics, std::move(where));
  }
  return open({std::move(*path), name, std::move(where), isolation}, diagnostics);
}

bool PluginSet::load_program(const Program& program, std::span<const std::string> directories,
                             Diagnostics& diagnostics, SourceLocation where) {
  if (has(program.name)) return true;
  warn_of_writable_directories(directories, where, diagnostics);
  auto path = find_program_file(program.file, directories);
  if (!path) {
    return refuse(program.name, std::move(path.error()), diagnostics, std::move(where));
  }
  return open_program({std::move(*path), program.name, std::move(where)}, program.hold,
                      diagnostics);
}

bool PluginSet::has(std::string_view name) const {
  return std::ranges::any_of(plugins_, [&](const auto& it) { return it->name() == name; });
}

bool PluginSet::add(const lockstep_plugin& plugin, std::string origin, Diagnostics& diagnostics,
                    SourceLocation where) {
  const Request request{std::move(origin), {}, std::move(where)};
  return accept(std::make_unique<Plugin>(Plugin{&plugin, request.origin}), 0, request, diagnostics);
}

bool PluginSet::open(const Request& request, Diagnostics& diagnostics) {
  if (std::ranges::any_of(
          plugins_, [&](const auto& it) { return is_same_file(it->origin, request.origin); })) {
    return true;
  }
  warn_of_writable_plugin(request.origin, request.where, diagnostics);
  if (isolation_.only_described || isolation_.all || request.isolation == Isolation::Isolated) {
    return open_isolated(request, diagnostics);
  }
  auto constant = constant_of(request.origin);
  if (!constant) {
    return refuse(request.origin, std::move(constant.error()), diagnostics, request.where);
  }
  const auto* const entry = static_cast<const lockstep_plugin*>(constant->address);
  return accept(std::make_unique<Plugin>(Plugin{entry, request.origin}), constant->size, request,
                diagnostics);
}

bool PluginSet::open_isolated(const Request& request, Diagnostics& diagnostics) {
  auto opened = IsolatedPlugin::open(request.origin, isolation_);
  if (!opened) {
    return refuse(request.origin, std::move(opened.error()), diagnostics, request.where);
  }
  return accept(*std::move(opened), request, diagnostics);
}

bool PluginSet::open_program(const Request& request, Hold hold, Diagnostics& diagnostics) {
  if (has(request.expected_name)) return true;
  warn_of_writable_plugin(request.origin, request.where, diagnostics);
  auto opened =
      ProgramPlugin::open(request.origin, std::string(request.expected_name), hold, isolation_);
  if (!opened) {
    return refuse(request.origin, std::move(opened.error()), diagnostics, request.where);
  }
  const std::string write_again =
      fmt::format("let 'lockstep plugin check --list --save {}' write it again", request.origin);
  if ((*opened)->is_file_stale()) {
    diagnostics.warning("stale-leaf-file"_code, request.where,
                        fmt::format("plugin '{}' has other leaves than '{}' lists",
                                    request.expected_name, leaves_file_of(request.origin)),
                        write_again);
  }
  if ((*opened)->is_file_older()) {
    diagnostics.note("stale-leaf-file"_code, request.where,
                     fmt::format("'{}' is older than the program: plugin '{}' may have "
                                 "other leaves now",
                                 leaves_file_of(request.origin), request.expected_name),
                     "give --run-programs, or " + write_again);
  }
  return accept(*std::move(opened), request, diagnostics);
}

bool PluginSet::accept(std::unique_ptr<RemotePlugin> remote, const Request& request,
                       Diagnostics& diagnostics) {
  auto plugin = std::make_unique<Plugin>(Plugin{&remote->entry(), request.origin});
  plugin->descriptors.plugin.remote = remote.get();
  plugin->descriptors.plugin.describer = remote->describer();
  plugin->descriptors.plugin.answers_late = remote->answers_late();
  plugin->remote = std::move(remote);
  return accept(std::move(plugin), 0, request, diagnostics);
}

bool PluginSet::accept(std::unique_ptr<Plugin> plugin, std::size_t size, const Request& request,
                       Diagnostics& diagnostics) {
  const lockstep_plugin& entry = *plugin->entry;
  if (std::ranges::any_of(plugins_, [&](const auto& it) { return it->entry == &entry; })) {
    return true;
  }
  const bool is_described = isolation_.only_described && request.isolation == Isolation::InProcess;
  auto refusal = plugin->read(size);
  if (!refusal && !is_described) refusal = plugin->check_isolation();
  if (!refusal) refusal = check_expected_name(plugin->name(), request.expected_name);
  for (const auto& other : plugins_) {
    if (!refusal) refusal = Plugin::check_against(*plugin, *other);
  }
  if (refusal) return refuse(request.origin, std::move(*refusal), diagnostics, request.where);
  std::unique_ptr<Plugin> rest;
  if (plugin->remote != nullptr && plugin->descriptors.plugin.is_local) {
    Diagnostic partly = isolated_in_part(*plugin, request);
    if (!isolation_.only_described) {
      rest = split_off(*plugin, request, diagnostics);
      if (rest == nullptr) return false;
    }
    diagnostics.add(std::move(partly));
  }
  plugins_.push_back(std::move(plugin));
  if (rest != nullptr) plugins_.push_back(std::move(rest));
  return true;
}

std::unique_ptr<PluginSet::Plugin> PluginSet::split_off(Plugin& isolated, const Request& request,
                                                        Diagnostics& diagnostics) {
  auto constant = constant_of(request.origin);
  auto rest = std::make_unique<Plugin>(Plugin{nullptr, request.origin});
  std::optional<Problem> refusal;
  if (constant) {
    rest->entry = static_cast<const lockstep_plugin*>(constant->address);
    refusal = rest->read(constant->size);
  } else {
    refusal = std::move(constant.error());
  }
  if (refusal) {
    refuse(request.origin, std::move(*refusal), diagnostics, request.where);
    return nullptr;
  }
  const auto stays = [](const auto& leaf) { return refuse_isolation(*leaf).has_value(); };
  std::erase_if(isolated.descriptors.leaves, stays);
  std::erase_if(rest->descriptors.leaves, [&](const auto& leaf) { return !stays(leaf); });
  rest->descriptors.plugin.is_local = true;
  isolated.descriptors.plugin.is_local = false;
  return rest;
}

Diagnostic PluginSet::isolated_in_part(const Plugin& plugin, const Request& request) {
  std::vector<std::string_view> ids;
  std::string why;
  for (const auto& leaf : plugin.descriptors.leaves) {
    const auto refusal = refuse_isolation(*leaf);
    if (!refusal) continue;
    if (ids.empty()) why = refusal->message;
    ids.push_back(leaf->node_type.id);
  }
  return {Severity::Warning,
          request.where,
          fmt::format("plugin '{}' is isolated only in part: {} {} in this process",
                      brief(request.origin), listed(ids), ids.size() == 1 ? "runs" : "run"),
          fmt::format("{}; the two parts share nothing but ports", why.substr(why.find(": ") + 2)),
          {},
          "partly-isolated"_code};
}

bool PluginSet::initialize(Diagnostics& diagnostics) {
  for (const auto& plugin : plugins_) {
    if (plugin->initialized) continue;
    if (std::string failure = plugin->initialize(); !failure.empty()) {
      return refuse(plugin->origin,
                    {std::move(failure), "the author of the plugin knows what it needs"},
                    diagnostics, {});
    }
    plugin->initialized = true;
  }
  return true;
}

std::vector<const NodeType*> PluginSet::types() const {
  std::vector<const NodeType*> types;
  for (const auto& plugin : plugins_) {
    for (const auto& leaf : plugin->descriptors.leaves) types.push_back(&leaf->node_type);
  }
  return types;
}

PluginWords PluginSet::words() const {
  PluginWords all;
  for (const auto& plugin : plugins_) {
    const bool is_elsewhere = isolation_.only_described && plugin->remote != nullptr;
    all.merge(is_elsewhere ? plugin->remote->script_words() : words_of(plugin->descriptors.plugin));
  }
  return all;
}

const lockstep_clock* PluginSet::clock(std::string_view name) const {
  for (const auto& plugin : plugins_) {
    if (plugin->remote != nullptr) continue;
    const lockstep_clock* const clock = clock_of(plugin->descriptors.plugin);
    if (clock != nullptr && name == clock->name) return clock;
  }
  return nullptr;
}

std::vector<PluginSet::Info> PluginSet::list() const {
  const auto text = [](const char* it) { return std::string(it == nullptr ? "" : it); };
  std::vector<Info> list;
  for (const auto& plugin : plugins_) {
    const lockstep_plugin& it = plugin->descriptors.plugin;
    const bool is_remote = plugin->remote != nullptr;
    list.push_back({text(it.name), text(it.version), text(it.doc), plugin->origin, is_remote,
                    is_remote ? plugin->remote->descriptions() : ""});
  }
  return list;
}

}  // namespace lockstep::host
