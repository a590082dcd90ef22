// A type of objects of an isolated plugin: here they are bytes, and texts are read there.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "plugin/contract/packed_object.h"

namespace lockstep {

class RemoteObjectType final : public PackedType {
 public:
  using FromText = std::function<Result<Object>(const PackedType& type, std::string_view)>;

  // Without `from_text` it has none.
  RemoteObjectType(std::string name, bool has_bytes, FromText from_text)
      : PackedType(std::move(name)), has_bytes_(has_bytes), from_text_(std::move(from_text)) {}

  bool has_from_text() const override { return from_text_ != nullptr; }
  Result<Object> from_text(std::string_view text) const override { return from_text_(*this, text); }
  bool has_bytes() const override { return has_bytes_; }

 private:
  bool has_bytes_;
  FromText from_text_;
};

}  // namespace lockstep
