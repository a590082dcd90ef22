#include "plugin/object_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

#include "plugin/descriptor.h"

namespace lockstep {
namespace {

constexpr std::size_t kSizeIn11 =
    offsetof(lockstep_object_type, from_text) + sizeof(lockstep_object_type::from_text);

class PluginObjectType final : public ObjectType {
 public:
  explicit PluginObjectType(const lockstep_object_type& declared)
      : ObjectType(declared.name), it_(declared) {}

  // The contract forbids exceptions; one that comes nevertheless is lost.
  void retain(void* object) const noexcept override {
    guarded([&] { it_.retain(object); });
  }
  void release(void* object) const noexcept override {
    guarded([&] { it_.release(object); });
  }
  void append_text(const void* object, std::string& out) const override {
    const std::size_t before = out.size();
    std::size_t room = 128;
    std::size_t length = 0;
    for (int round = 0; it_.to_text != nullptr && round < 2; ++round) {
      out.resize(before + room);
      guarded([&] { length = it_.to_text(object, out.data() + before, room); });
      if (length <= room) break;
      room = length;
    }
    out.resize(before + std::min(length, room));
    if (it_.to_text == nullptr) out.append("(").append(name()).append(")");
  }
  bool has_from_text() const override { return it_.from_text != nullptr; }
  std::optional<Object> from_text(std::string_view text) const override {
    void* object = nullptr;
    guarded([&] { object = it_.from_text(text.data(), text.size()); });
    if (object == nullptr) return std::nullopt;
    return Object(*this, object);
  }

 private:
  template <class Call>
  static void guarded(Call call) noexcept {
    try {
      call();
    } catch (...) {  // NOLINT(bugprone-empty-catch)
    }
  }

  lockstep_object_type it_;
};

bool is_type_name(std::string_view name) {
  return !name.empty() && name.size() <= 100 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._:/-").find(c) != std::string_view::npos;
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
  return std::nullopt;
}

}  // namespace

Result<const ObjectType*> read_object_type(const lockstep_object_type* declared) {
  if (auto problem = check(declared)) return tl::unexpected(std::move(*problem));
  static std::mutex mutex;
  // Never destroyed: the program may keep objects until its end.
  static auto& types =
      *new std::map<const lockstep_object_type*, std::unique_ptr<const ObjectType>>;
  const std::lock_guard lock(mutex);
  auto& type = types[declared];
  if (type == nullptr) {
    type = std::make_unique<PluginObjectType>(covered_copy(declared, declared->struct_size));
  }
  return type.get();
}

}  // namespace lockstep
