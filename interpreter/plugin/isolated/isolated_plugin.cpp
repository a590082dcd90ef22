#include "plugin/isolated/isolated_plugin.h"

#include <fmt/format.h>

#include <algorithm>

#include "plugin/isolated/remote_run.h"

namespace lockstep {
namespace {

std::string words(const Session& session) {
  const std::string& words = session.last_words();
  return words.starts_with("did ") ? "it " + words : words;
}

// Calls init in the process. "" or why it did not work.
std::string initialize_in(Session& session) {
  session.begin_request(PluginFunction::Init);
  if (!session.call({})) return "does not survive its init: " + words(session);
  MessageReader answer = session.answer();
  std::string failure(answer.text());
  if (answer.good()) return failure;
  session.reject_answer();
  return "does not survive its init: " + words(session);
}

// The children of a control node are leaves of other processes, or of this one.
std::optional<Problem> refuse_what_is_local(const lockstep_plugin& plugin) {
  for (std::uint32_t index = 0; index < plugin.leaf_type_count; ++index) {
    const lockstep_leaf_type& type = *plugin.leaf_types[index];
    for (std::uint32_t port = 0; port < type.port_count; ++port) {
      if (type.ports[port]->type != LOCKSTEP_OBJECT) continue;
      return Problem{fmt::format("cannot be isolated: the port '{}' of '{}' carries objects",
                                 type.ports[port]->name, type.id),
                     "load it without isolation: an object cannot leave its process"};
    }
    if (type.kind != LOCKSTEP_CONTROL && type.kind != LOCKSTEP_DECORATOR) continue;
    return Problem{fmt::format("cannot be isolated: '{}' is a {}", type.id,
                               type.kind == LOCKSTEP_CONTROL ? "control node" : "decorator"),
                   "load it without isolation, or move its leaves into another plugin"};
  }
  return std::nullopt;
}

}  // namespace

IsolatedPlugin::IsolatedPlugin(std::string path, IsolationOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

IsolatedPlugin::~IsolatedPlugin() {
  for (const auto& session : idle_) session->end();
}

Result<std::unique_ptr<IsolatedPlugin>> IsolatedPlugin::open(const std::string& path,
                                                             const IsolationOptions& options) {
  std::unique_ptr<IsolatedPlugin> plugin(new IsolatedPlugin(path, options));
  auto session = std::make_unique<Session>();
  if (auto refusal = plugin->start(*session)) return tl::unexpected(std::move(*refusal));
  plugin->idle_.push_back(std::move(session));
  return plugin;
}

// A process that has the plugin loaded.
std::optional<Problem> IsolatedPlugin::start(Session& session) {
  if (std::string failure = session.start(options_, path_); !failure.empty()) {
    return Problem{
        fmt::format("cannot be isolated: '{}' does not start: {}", options_.leafhost, failure),
        "lockstep-leafhost is installed with lockstep, in libexec/lockstep"};
  }
  session.begin_request(PluginFunction::Load);
  if (!session.call({})) {
    return Problem{"cannot be loaded: " + words(session),
                   "the constructors of a shared object run while it is loaded"};
  }
  MessageReader answer = session.answer();
  if (answer.has_text()) {
    std::string message(answer.text());
    return Problem{std::move(message), std::string(answer.text())};
  }
  return describe(answer);
}

// What the first process says, the others must say too.
std::optional<Problem> IsolatedPlugin::describe(MessageReader description) {
  const auto bytes = description.rest();
  if (!description_.empty()) {
    if (std::ranges::equal(bytes, description_)) return std::nullopt;
    return Problem{"has changed since it was loaded", "start lockstep again"};
  }
  description_.assign(bytes.begin(), bytes.end());
  if (descriptors_.read(description, remote_plugin(), remote_leaf_type())) {
    return refuse_what_is_local(entry());
  }
  return Problem{"cannot be loaded: its process sent an invalid answer",
                 "is lockstep-leafhost of the same build as lockstep?"};
}

std::optional<std::uint32_t> IsolatedPlugin::index_of(const lockstep_leaf_type& type) const {
  for (std::uint32_t index = 0; index < entry().leaf_type_count; ++index) {
    if (entry().leaf_types[index]->id == type.id) return index;
  }
  return std::nullopt;
}

std::string IsolatedPlugin::initialize() {
  return idle_.empty() ? "" : initialize_in(*idle_.front());
}

std::unique_ptr<Session> IsolatedPlugin::acquire(std::string& failure) {
  {
    const std::lock_guard lock(mutex_);
    while (!idle_.empty()) {
      auto session = std::move(idle_.back());
      idle_.pop_back();
      if (!session->is_gone()) return session;
    }
  }
  auto session = std::make_unique<Session>();
  if (auto refusal = start(*session)) {
    failure = refusal->message;
  } else {
    failure = initialize_in(*session);
  }
  return failure.empty() ? std::move(session) : nullptr;
}

void IsolatedPlugin::release(std::unique_ptr<Session> session) {
  if (session->is_gone()) return;
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(session));
}

}  // namespace lockstep
