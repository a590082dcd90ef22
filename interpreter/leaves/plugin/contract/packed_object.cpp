#include "leaves/plugin/contract/packed_object.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>

namespace lockstep::host {
namespace {

struct Counted : PackedObject {
  explicit Counted(PackedObject packed) : PackedObject(std::move(packed)) {}
  std::atomic<std::size_t> references{1};
};

const PackedObject& packed_in(const void* object) {
  return *static_cast<const Counted*>(object);
}

}  // namespace

const PackedType& PackedType::of(std::string_view name) {
  static std::mutex mutex;
  // Never destroyed: the program may keep objects until its end.
  static auto& types = *new std::map<std::string, std::unique_ptr<const PackedType>, std::less<>>;
  const std::lock_guard lock(mutex);
  auto found = types.find(name);
  if (found == types.end()) {
    found = types.emplace(name, std::make_unique<PackedType>(std::string(name))).first;
  }
  return *found->second;
}

Object PackedType::make(PackedObject packed) const {
  return {of(name()), new Counted(std::move(packed))};
}

const PackedObject& PackedType::get(const Object& object) {
  return packed_in(object.get());
}

void PackedType::retain(void* object) const noexcept {
  ++static_cast<Counted*>(object)->references;
}

void PackedType::release(void* object) const noexcept {
  auto* const counted = static_cast<Counted*>(object);
  if (--counted->references == 0) delete counted;
}

void PackedType::append_text(const void* object, std::string& out) const {
  out += packed_in(object).text;
}

Result<std::string> PackedType::to_bytes(const void* object) const {
  return packed_in(object).bytes;
}

Result<Object> PackedType::from_bytes(std::string_view bytes) const {
  return make({std::string(bytes), {}});
}

Result<Object> pack(const Object& object, WithText with_text) {
  auto bytes = object.type()->to_bytes(object.get());
  if (!bytes) return tl::unexpected(std::move(bytes.error()));
  PackedObject packed{*std::move(bytes), {}};
  if (with_text == WithText::Yes) object.type()->append_text(object.get(), packed.text);
  return PackedType::of(object.type()->name()).make(std::move(packed));
}

}  // namespace lockstep::host
