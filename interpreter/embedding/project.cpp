// lockstep_project: the settings, the loading, and what was loaded.
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "base/core/audience.h"
#include "base/core/parameter_value.h"
#include "base/core/plugin_exception.h"
#include "base/core/suggest.h"
#include "base/core/utf8.h"
#include "base/core/wording.h"
#include "embedding/groot.h"
#include "embedding/handles.h"
#include "run/checkpoint/checkpoint.h"

namespace lockstep::host {

TreeTexts::TreeTexts(const Tree& tree) {
  for (const Slot& slot : tree.slots) types.emplace_back(type_name(slot.type, slot.object));
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    paths.push_back(tree.path(node));
    names.emplace_back(tree.labels[node].name);
    ids.emplace_back(tree.labels[node].type->id);
  }
}

}  // namespace lockstep::host

namespace lockstep::host::embedding {
namespace {

thread_local std::string t_error;

constexpr std::size_t kLongestError = 2000;  // bytes
constexpr std::uint32_t kVersion = LOCKSTEP_RUNTIME_MAJOR << 16 | LOCKSTEP_RUNTIME_MINOR;

// Files that are installed with lockstep are found from this library, whatever program it is in: in
// a build directory beside it, else as seen from the directory of programs.
std::string program_directory() {
  Dl_info info{};
  if (dladdr(&kVersion, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const auto directory = std::filesystem::canonical(info.dli_fname, error).parent_path();
  if (std::filesystem::exists(directory / "lockstep-leafhost", error)) return directory.string();
  return (directory / LOCKSTEP_BIN_FROM_LIB).lexically_normal().string();
}

// Changes a setting of a project that has not been loaded.
template <class Change>
bool set(lockstep_project* project, const void* argument, Change change) {
  return guarded([&] {
    if (project == nullptr || argument == nullptr) return fail("an argument is NULL");
    if (project->load_tried) return fail("the project has been loaded already");
    change();
    return true;
  });
}

// True if all texts of a call that sets something can be set.
bool are_texts(std::initializer_list<std::pair<const char*, const char*>> texts) {
  return guarded([&] {
    return std::ranges::all_of(texts, [](const auto& it) { return is_text(it.first, it.second); });
  });
}

// `name` is that of the tree's file.
template <class Load>
bool load_with(lockstep_project* project, const char* name, const void* argument, Load load) {
  return set(project, argument, [] {}) && guarded([&] {
           const ForProgram scope;
           project->load_tried = true;
           project->process = OwnProcess();
           auto loaded = load();
           const bool plays = project->played != nullptr;  // then no plugin is called
           if (loaded && (plays || project->plugins->initialize(project->diagnostics))) {
             auto shown = project->shows_groot ? groot_of(loaded->definition) : nullptr;
             if (plays) project->played->take_over(loaded->definition);
             TreeIdentity identity = identity_of(*loaded, text_mark);
             project->program = std::make_shared<Program>(project->played, std::move(identity),
                                                          make_runnable(std::move(*loaded)), name,
                                                          std::move(shown));
           }
           project->diagnostics.sort();
           return project->program != nullptr ||
                  fail("the tree has errors: see the diagnostics of its project");
         });
}

const Tree* loaded_tree(const lockstep_project* project) {
  return project == nullptr || !project->program ? nullptr : &project->program->runnable.tree;
}

// The types of the contract have the numbers of the interpreter's, but for those that only entries
// have.
lockstep_type type_of(const Slot& slot) {
  if (slot.typing == Typing::Any) return LOCKSTEP_ANY;
  return slot.type == ValueType::Number ? LOCKSTEP_NUMBER : static_cast<lockstep_type>(slot.type);
}

}  // namespace

bool fail(std::string_view reason) noexcept {
  try {
    t_error = reason.size() <= kLongestError
                  ? reason
                  : fmt::format("{} ... ({} more bytes)", utf8_front(reason, kLongestError),
                                reason.size() - utf8_front(reason, kLongestError).size());
  } catch (...) {
    t_error.clear();  // no memory: what fits a string without any is too short to say so
  }
  return false;
}

bool is_text(std::string_view what, const char* text) noexcept {
  return is_text(what, text, text == nullptr ? 0 : std::strlen(text));
}

bool is_text(std::string_view what, const char* text, std::size_t length) noexcept {
  if (text == nullptr) return fail("an argument is NULL");
  if (is_utf8({text, length})) return true;
  return shielded([&] { return fail(fmt::format("{} is not UTF-8", what)); });
}

std::optional<std::uint32_t> find_slot(const Tree& tree, const char* key) {
  if (!is_text("the key", key)) return std::nullopt;
  const auto found = std::ranges::find(tree.slots, std::string_view(key), &Slot::name);
  if (found != tree.slots.end()) return static_cast<std::uint32_t>(found - tree.slots.begin());
  std::vector<std::string_view> keys;
  for (const Slot& slot : tree.slots) keys.push_back(slot.name);
  const std::string hint = did_you_mean(key, keys);
  fail(fmt::format("no node uses an entry '{}'{}{}", brief(key), hint.empty() ? "" : "; ", hint));
  return std::nullopt;
}

void forget_error() noexcept {
  t_error.clear();
}

}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

uint32_t lockstep_runtime_version(void) {
  return kVersion;
}

const char* lockstep_last_error(void) {
  return t_error.c_str();
}

lockstep_project* lockstep_project_new(void) {
  return guarded([] {
    ready_to_catch();  // also what the program's own leaves throw
    auto project = std::make_unique<lockstep_project>();
    project->options.plugins.program_directory = program_directory();
    project->options.plugins.run_programs = true;
    project->options.main_file = MainFile::IsRegular;
    return project.release();
  });
}

// The processes of its plugins are those of the process that has loaded it.
void lockstep_project_free(lockstep_project* project) {
  if (project != nullptr && project->process.is_this()) delete project;
}

bool lockstep_project_add_plugin_path(lockstep_project* project, const char* directory) {
  return set(project, directory,
             [&] { project->options.plugins.directories.emplace_back(directory); });
}

bool lockstep_project_add_plugin(lockstep_project* project, const char* plugin) {
  return set(project, plugin, [&] { project->options.plugins.plugins.emplace_back(plugin); });
}

bool lockstep_project_add_leaves(lockstep_project* project, const lockstep_plugin* plugin) {
  bool added = false;
  return set(project, plugin,
             [&] {
               Diagnostics refused;
               added = project->plugins->add(*plugin, "this program", refused);
               if (added) return;
               const Diagnostic& why = refused.all().front();
               fail(why.hint.empty() ? why.message : fmt::format("{} ({})", why.message, why.hint));
             }) &&
         added;
}

bool lockstep_project_set_argument(lockstep_project* project, const char* name, const char* value) {
  return are_texts({{"the name", name}, {"the value", value}}) &&
         set(project, value, [&] { project->options.arguments[name] = value; });
}

bool lockstep_project_set_value(lockstep_project* project, const char* key, const char* value) {
  return are_texts({{"the key", key}, {"the value", value}}) &&
         set(project, value, [&] { project->options.values[key] = value; });
}

bool lockstep_project_set_main_tree(lockstep_project* project, const char* id) {
  return are_texts({{"the ID", id}}) && set(project, id, [&] { project->options.main_tree = id; });
}

bool lockstep_project_isolate_all(lockstep_project* project) {
  return set(project, project, [&] { project->options.plugins.isolate = true; });
}

bool lockstep_project_open_entries(lockstep_project* project, bool has_outside) {
  return set(project, project, [&] {
    project->options.opens_entries = true;
    project->options.has_outside = has_outside;
  });
}

bool lockstep_project_show_groot2(lockstep_project* project) {
  return set(project, project, [&] { project->shows_groot = true; });
}

bool lockstep_project_load_file(lockstep_project* project, const char* path) {
  return load_with(project, path, path, [&] {
    return load(path, project->options, project->diagnostics, project->plugins);
  });
}

bool lockstep_project_load_text(lockstep_project* project, const char* name, const char* text,
                                size_t length) {
  return load_with(project, name, name == nullptr ? nullptr : text, [&] {
    return load_text(name, std::string(text, length), project->options, project->diagnostics,
                     project->plugins);
  });
}

uint32_t lockstep_project_diagnostic_count(const lockstep_project* project) {
  return project == nullptr ? 0 : static_cast<uint32_t>(project->diagnostics.all().size());
}

bool lockstep_project_diagnostic(const lockstep_project* project, uint32_t index,
                                 lockstep_diagnostic* diagnostic) {
  return guarded([&] {
    if (index >= lockstep_project_diagnostic_count(project)) return fail("no such diagnostic");
    const Diagnostic& it = project->diagnostics.all()[index];
    return write_struct({.struct_size = 0,
                         .severity = static_cast<int32_t>(it.severity),
                         .file = it.location.file.c_str(),
                         .line = it.location.line,
                         .column = it.location.column,
                         .message = it.message.c_str(),
                         .hint = it.hint.c_str()},
                        diagnostic);
  });
}

uint32_t lockstep_project_node_count(const lockstep_project* project) {
  const Tree* const tree = loaded_tree(project);
  return tree == nullptr ? 0 : static_cast<uint32_t>(tree->nodes.size());
}

bool lockstep_project_node(const lockstep_project* project, uint32_t index, lockstep_node* node) {
  return guarded([&] {
    if (index >= lockstep_project_node_count(project)) return fail("no such node");
    const Program& program = *project->program;
    const TreeTexts& texts = program.texts();
    const NodeLabel& label = program.runnable.tree.labels[index];
    return write_struct({.struct_size = 0,
                         .parent = label.parent,
                         .end = program.runnable.tree.nodes[index].end,
                         .path = texts.paths[index].c_str(),
                         .name = texts.names[index].c_str(),
                         .id = texts.ids[index].c_str()},
                        node);
  });
}

bool lockstep_project_find_node(const lockstep_project* project, const char* path,
                                uint32_t* index) {
  return guarded([&] {
    if (loaded_tree(project) == nullptr) return fail("the project has not been loaded");
    if (!is_text("the path", path)) return false;
    if (index == nullptr) return fail("an argument is NULL");
    const auto& paths = project->program->texts().paths;
    const auto found = std::ranges::find(paths, path);
    if (found == paths.end()) return fail(fmt::format("there is no node '{}'", brief(path)));
    *index = static_cast<uint32_t>(found - paths.begin());
    return true;
  });
}

uint32_t lockstep_project_entry_count(const lockstep_project* project) {
  const Tree* const tree = loaded_tree(project);
  return tree == nullptr ? 0 : static_cast<uint32_t>(tree->slots.size());
}

bool lockstep_project_entry(const lockstep_project* project, uint32_t index,
                            lockstep_entry* entry) {
  return guarded([&] {
    if (index >= lockstep_project_entry_count(project)) return fail("no such entry");
    const Slot& slot = project->program->runnable.tree.slots[index];
    const bool is_any = slot.typing == Typing::Any;
    return write_struct(
        {.struct_size = 0,
         .type = type_of(slot),
         .key = slot.name.c_str(),
         .type_name = is_any ? "any" : project->program->texts().types[index].c_str()},
        entry);
  });
}

bool lockstep_project_find_entry(const lockstep_project* project, const char* key,
                                 uint32_t* index) {
  return guarded([&] {
    const Tree* const tree = loaded_tree(project);
    if (tree == nullptr) return fail("the project has not been loaded");
    if (index == nullptr) return fail("an argument is NULL");
    const auto slot = find_slot(*tree, key);
    if (slot) *index = *slot;
    return slot.has_value();
  });
}
