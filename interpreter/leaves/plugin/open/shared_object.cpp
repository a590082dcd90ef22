#include "leaves/plugin/open/shared_object.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <atomic>
#include <mutex>
#include <set>
#include <string_view>

#include "base/core/plugin_exception.h"
#include "base/core/wording.h"
#include "base/system/call_mark.h"
#include "base/system/float_mode.h"
#include "leaves/plugin/open/elf_file.h"

namespace lockstep::host {
namespace {

// The linker's last words, without the path that the message names already.
std::string linker_error(const std::string& path) {
  const char* text = dlerror();
  std::string_view error = text == nullptr ? "unknown error" : text;
  if (error.starts_with(path)) {
    error.remove_prefix(path.size());
    if (error.starts_with(": ")) error.remove_prefix(2);
  }
  return std::string(error);
}

std::string hint_for(std::string_view error) {
  if (error.find("undefined symbol") != error.npos) {
    return "link the plugin with the library that defines it; functions of lockstep are reached "
           "through the host table only";
  }
  if (error.find("static TLS") != error.npos) {
    return "thread-local variables of it, or of a library that it needs, must have their place "
           "when the program starts: set GLIBC_TUNABLES=glibc.rtld.optional_static_tls=4194304, or "
           "name the library in LD_PRELOAD";
  }
  return "'ldd' lists the libraries that it needs and which of them are missing";
}

std::atomic<const CallSite*> g_opened{nullptr};

void note_opened(const std::string& path) {
  static std::mutex mutex;
  static std::set<std::string> paths;
  const std::lock_guard lock(mutex);
  if (!paths.insert(path).second) return;
  g_opened = &CallSite::of_plugin(joined(paths, "' or '"));
}

}  // namespace

const CallSite* opened_shared_objects() {
  return g_opened;
}

Result<SharedObject> open_shared_object(const std::string& path) {
  if (auto refusal = inspect_elf_file(path)) return tl::unexpected(std::move(*refusal));
  // A name without a slash would be searched in the system's library directories.
  const std::string file = path.find('/') == path.npos ? "./" + path : path;
  ready_to_catch();
  SharedObject object;
  const FloatMode mode = FloatMode::current();
  {
    const MarkedCall mark(CallSite::of_plugin(path), PluginFunction::Load);
    object.handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  mode.restore();
  if (object.handle != nullptr) {
    note_opened(path);
    return object;
  }
  const std::string error = linker_error(file);
  return problem(fmt::format("cannot be loaded: {}", error), hint_for(error));
}

Result<ExportedConstant> find_constant(const SharedObject& object, const char* symbol) {
  ExportedConstant found{.address = dlsym(object.handle, symbol)};
  if (found.address == nullptr) {
    return problem(fmt::format("does not export '{}'", symbol),
                   "is it a lockstep plugin? `lockstep docs plugins` shows how one is built");
  }
  Dl_info info{};
  void* extra = nullptr;
  if (dladdr1(found.address, &info, &extra, RTLD_DL_SYMENT) == 0 || extra == nullptr) {
    return found;
  }
  const auto& entry = *static_cast<const ElfW(Sym)*>(extra);
  if (ELF64_ST_TYPE(entry.st_info) == STT_FUNC) {
    return problem(fmt::format("exports '{}' as a function", symbol),
                   "define it as a constant of type lockstep_plugin");
  }
  found.size = entry.st_size;
  return found;
}

}  // namespace lockstep::host
