// Objects of another process: their bytes, and the text that views show. A plugin of this process
// that reads one gets an object made of the bytes.
#pragma once

#include <string>
#include <string_view>

#include "base/core/object.h"

namespace lockstep::host {

struct PackedObject {
  std::string bytes;
  std::string text;
};

class PackedType : public ObjectType {
 public:
  // The same for the same name; lives until the process ends.
  static const PackedType& of(std::string_view name);
  explicit PackedType(std::string name) : ObjectType(std::move(name)) {}
  Object make(PackedObject packed) const;
  // The object must be of a PackedType.
  static const PackedObject& get(const Object& object);

  void retain(void* object) const noexcept override;
  void release(void* object) const noexcept override;
  void append_text(const void* object, std::string& out) const override;
  bool has_from_text() const override { return false; }
  Result<Object> from_text(std::string_view /*text*/) const override { return problem({}); }
  bool has_bytes() const override { return true; }
  Result<std::string> to_bytes(const void* object) const override;
  Result<Object> from_bytes(std::string_view bytes) const override;
  bool is_packed() const override { return true; }
};

// Calls to_bytes of the object's type, and to_text if the text is wanted.
enum class WithText : bool { No, Yes };
Result<Object> pack(const Object& object, WithText with_text);

}  // namespace lockstep::host
