#include "leaves/remote/shared_memory/isolated_plugin.h"

#include <fmt/format.h>

#include <algorithm>

#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/remote/shared_memory/isolated_run.h"

namespace lockstep::host {
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
  plugin->release(std::move(session));
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

// Every further process must give the same description as the first.
std::optional<Problem> IsolatedPlugin::describe(MessageReader description) {
  const auto bytes = description.rest();
  if (!description_.empty()) {
    if (std::ranges::equal(bytes, description_)) return std::nullopt;
    return Problem{"has changed since it was loaded", "start lockstep again"};
  }
  description_.assign(bytes.begin(), bytes.end());
  const auto read_text = [this](const PackedType& type, std::string_view text) {
    return from_text(type, text);
  };
  if (descriptors_.read(description, read_text)) {
    return std::nullopt;
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
  const Lock lock(mutex_);
  return idle_.empty() ? "" : initialize_in(*idle_.front());
}

// Null when all are used.
std::unique_ptr<Session> IsolatedPlugin::take_idle() {
  const Lock lock(mutex_);
  while (!idle_.empty()) {
    auto session = std::move(idle_.back());
    idle_.pop_back();
    if (!session->is_gone()) return session;
  }
  return nullptr;
}

// A process that was started for this ends with it: init has not been called in it.
Result<Object> IsolatedPlugin::from_text(const PackedType& type, std::string_view text) {
  auto session = take_idle();
  const bool is_new = session == nullptr;
  if (is_new) {
    session = std::make_unique<Session>();
    if (auto failure = start(*session)) return tl::unexpected(std::move(*failure));
  }
  MessageWriter& request = session->begin_request(PluginFunction::FromText);
  request.put_text(type.name());
  request.put_text(text);
  Value value;
  std::string why;
  if (session->request_fits() && session->call({})) {
    MessageReader answer = session->answer();
    if (answer.value_into(value, &type)) {
      why = answer.text();
    } else {
      session->reject_answer();
    }
  }
  is_new ? session->end() : release(std::move(session));
  auto* const object = std::get_if<Object>(&value);
  if (object == nullptr) return problem(std::move(why));
  return std::move(*object);
}

// As from_text does.
tl::expected<const lockstep_leaf_type*, ElementRefusal> IsolatedPlugin::describe(
    std::string_view id, std::span<const FixedText> fixed) {
  const auto refused = [](std::string message, std::string hint = {}) {
    return tl::unexpected(ElementRefusal{{}, {std::move(message), std::move(hint)}});
  };
  auto session = take_idle();
  const bool is_new = session == nullptr;
  if (is_new) {
    session = std::make_unique<Session>();
    if (auto failure = start(*session)) return refused(failure->message, failure->hint);
  }
  MessageWriter& request = session->begin_request(PluginFunction::Describe);
  request.put_text(id);
  write_fixed(fixed, request);
  tl::expected<const lockstep_leaf_type*, ElementRefusal> described =
      refused(fmt::format("'{}' cannot be described: the process of its plugin has ended", id));
  if (session->request_fits() && session->call({})) {
    MessageReader answer = session->answer();
    described = read_described(answer);
    if (!answer.good()) session->reject_answer();
  }
  is_new ? session->end() : release(std::move(session));
  return described;
}

tl::expected<const lockstep_leaf_type*, ElementRefusal> IsolatedPlugin::read_described(
    MessageReader& answer) {
  if (answer.has_text()) {
    ElementRefusal refusal{.why = {std::string(answer.text()), std::string(answer.text())}};
    refusal.parameter = answer.text();
    return tl::unexpected(std::move(refusal));
  }
  const auto read_text = [this](const PackedType& type, std::string_view text) {
    return from_text(type, text);
  };
  const Lock lock(mutex_);
  const lockstep_leaf_type* const type = described_.emplace_back().read_one(answer, read_text);
  if (type != nullptr) return type;
  return tl::unexpected(
      ElementRefusal{.why = {"the process of its plugin sent an invalid answer"}});
}

Result<std::unique_ptr<Session>> IsolatedPlugin::acquire() {
  if (auto idle = take_idle()) return idle;
  auto session = std::make_unique<Session>();
  if (auto refusal = start(*session)) return tl::unexpected(std::move(*refusal));
  if (auto failure = initialize_in(*session); !failure.empty()) return problem(std::move(failure));
  return session;
}

std::unique_ptr<RemoteRun> IsolatedPlugin::begin_run(const lockstep_caller& caller) {
  auto session = acquire();
  if (!session) {
    host_table().set_error(&caller, session.error().message.c_str());
    return nullptr;
  }
  return begin_isolated_run(*this, *std::move(session), caller);
}

void IsolatedPlugin::release(std::unique_ptr<Session> session) {
  if (session->is_gone()) return;
  const Lock lock(mutex_);
  idle_.push_back(std::move(session));
}

}  // namespace lockstep::host
