#include "leaves/plugin/contract/object_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "leaves/plugin/contract/descriptor.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kSizeIn11 =
    offsetof(lockstep_object_type, from_text) + sizeof(lockstep_object_type::from_text);

// Lets to_text or to_bytes fill the text: with some room, and again if that was not enough. Returns
// the length that it has given last.
template <class Fill>
std::size_t fill(std::string& out, std::size_t room, std::size_t most, Fill function) {
  const std::size_t before = out.size();
  const auto call = [&] {
    out.resize(before + room);
    return function(out.data() + before, room);
  };
  std::size_t length = call();
  if (length > room && length <= most) {
    room = length;
    length = call();
  }
  out.resize(before + std::min(length, room));
  return length;
}

class PluginObjectType final : public ObjectType {
 public:
  PluginObjectType(const lockstep_object_type& declared, std::string_view plugin)
      : ObjectType(declared.name),
        it_(declared),
        site_(CallSite::of({.path = declared.name,
                            .plugin = plugin,
                            .kind = CallSite::kObjectType,
                            .is_local = !has_both(declared)})) {}

  // The contract forbids exceptions; one that comes nevertheless is lost.
  void retain(void* object) const noexcept override {
    guarded(PluginFunction::Retain, [&] { it_.retain(object); });
  }
  void release(void* object) const noexcept override {
    guarded(PluginFunction::Release, [&] { it_.release(object); });
  }
  void append_text(const void* object, std::string& out) const override {
    if (it_.to_text == nullptr) {
      out.append("(").append(name()).append(")");
      return;
    }
    const std::size_t before = out.size();
    const std::string thrown = guarded(PluginFunction::ToText, [&] {
      fill(out, 128, kMostText,
           [&](char* text, std::size_t room) { return it_.to_text(object, text, room); });
    });
    if (!thrown.empty()) out.resize(before);
  }
  bool has_from_text() const override { return it_.from_text != nullptr; }
  Result<Object> from_text(std::string_view text) const override {
    void* object = nullptr;
    std::string why;
    guarded(PluginFunction::FromText, [&] {
      object = it_.from_text(text.data(), text.size());
      const bool says_why = object == nullptr && it_.why_no_object != nullptr;
      const char* const reason = says_why ? it_.why_no_object() : nullptr;
      if (reason != nullptr) why.assign(reason, strnlen(reason, kMostReason));
    });
    if (object == nullptr) return problem(std::move(why));
    return Object(*this, object);
  }

  bool reads(std::string_view name) const override {
    if (name == this->name()) return true;
    bool reads = false;
    if (it_.reads != nullptr) {
      const std::string other(name);
      guarded(PluginFunction::Reads, [&] { reads = it_.reads(other.c_str()); });
    }
    return reads;
  }

  bool has_bytes() const override { return has_both(it_); }
  Result<std::string> to_bytes(const void* object) const override {
    std::string bytes;
    std::size_t length = 0;
    const std::string thrown = guarded(PluginFunction::ToBytes, [&] {
      length = fill(bytes, 4096, kMostBytes,
                    [&](char* data, std::size_t room) { return it_.to_bytes(object, data, room); });
    });
    if (!thrown.empty()) return failure("to_bytes", thrown);
    if (length == SIZE_MAX) return failure("to_bytes", "has failed");
    if (length > kMostBytes) {
      return failure("to_bytes", fmt::format("has {} bytes, at most {} MiB can leave a process",
                                             length, kMostBytes >> 20));
    }
    if (length != bytes.size()) {
      return failure("to_bytes",
                     fmt::format("has {} bytes, after {} a moment before", length, bytes.size()));
    }
    return bytes;
  }
  Result<Object> from_bytes(std::string_view bytes) const override {
    if (!has_bytes()) return failure("from_bytes", "does not exist");
    void* object = nullptr;
    const std::string thrown = guarded(
        PluginFunction::FromBytes, [&] { object = it_.from_bytes(bytes.data(), bytes.size()); });
    if (!thrown.empty()) return failure("from_bytes", thrown);
    if (object == nullptr) {
      return failure("from_bytes", fmt::format("finds no object in {} bytes", bytes.size()));
    }
    return Object(*this, object);
  }

 private:
  // Longer ones are cut off.
  static constexpr std::size_t kMostText = std::size_t{1} << 30, kMostReason = 500;
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  static bool has_both(const lockstep_object_type& declared) {
    return declared.to_bytes != nullptr && declared.from_bytes != nullptr;
  }

  // Returns the description of what it threw, or "".
  template <class Call>
  std::string guarded(PluginFunction function, Call call) const noexcept {
    const MarkedCall mark(site_, function);
    return thrown_by(call);
  }

  tl::unexpected<Problem> failure(std::string_view function, std::string_view what) const {
    return tl::unexpected(Problem{fmt::format("{} of '{}' {}", function, name(), what)});
  }

  lockstep_object_type it_;
  const CallSite& site_;
};

bool is_type_name(std::string_view name) {
  const bool is_padded = name.starts_with(' ') || name.ends_with(' ');
  return !name.empty() && name.size() <= 100 && !is_padded && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._:/- <>,*&()[]").find(c) != std::string_view::npos;
  });
}

std::optional<Problem> check(const lockstep_object_type* declared) {
  if (declared == nullptr) {
    return Problem{"carries objects of no type", "set lockstep_port::object"};
  }
  if (declared->struct_size < kSizeIn11) {
    return Problem{fmt::format("has a type of objects with struct_size {}, expected at least {}",
                               declared->struct_size, kSizeIn11),
                   "set it to sizeof(lockstep_object_type)"};
  }
  if (declared->name == nullptr || !is_type_name(declared->name)) {
    return Problem{fmt::format("has a type of objects with the name '{}'",
                               declared->name == nullptr ? "" : declared->name),
                   "use up to 100 letters, digits and '._:/-', such as 'nav.Path'"};
  }
  if (declared->retain == nullptr || declared->release == nullptr) {
    return Problem{
        fmt::format("has a type of objects, '{}', without retain and release", declared->name),
        "set both"};
  }
  const lockstep_object_type whole = covered_copy(declared, declared->struct_size);
  if ((whole.to_bytes == nullptr) != (whole.from_bytes == nullptr)) {
    const bool has_one = whole.to_bytes != nullptr;
    return Problem{
        fmt::format("has a type of objects, '{}', with {} without {}", declared->name,
                    has_one ? "to_bytes" : "from_bytes", has_one ? "from_bytes" : "to_bytes"),
        "set both or none"};
  }
  return std::nullopt;
}

}  // namespace

Result<const ObjectType*> read_object_type(const lockstep_object_type* declared,
                                           std::string_view plugin) {
  if (auto problem = check(declared)) return tl::unexpected(std::move(*problem));
  if (declared->retain == HostedObjectType::mark) {
    return static_cast<const HostedObjectType*>(declared)->type;
  }
  static std::mutex mutex;
  // Never destroyed: the program may keep objects until its end.
  static auto& types =
      *new std::map<const lockstep_object_type*, std::unique_ptr<const ObjectType>>;
  const std::lock_guard lock(mutex);
  auto& type = types[declared];
  if (type == nullptr) {
    type =
        std::make_unique<PluginObjectType>(covered_copy(declared, declared->struct_size), plugin);
  }
  return type.get();
}

}  // namespace lockstep::host
