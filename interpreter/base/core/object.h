// Objects that ports and entries carry by reference count. Plugins declare their types; two types
// of the same name are one. An object does not change.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/core/problem.h"

namespace lockstep::host {

class Object;

class ObjectType {
 public:
  explicit ObjectType(std::string name) : name_(std::move(name)) {}
  virtual ~ObjectType() = default;
  ObjectType(const ObjectType&) = delete;
  ObjectType& operator=(const ObjectType&) = delete;

  std::string_view name() const { return name_; }
  virtual void retain(void* object) const noexcept = 0;
  virtual void release(void* object) const noexcept = 0;
  // The name in parentheses if its objects have no text.
  virtual void append_text(const void* object, std::string& out) const = 0;
  virtual bool has_from_text() const = 0;
  // A failure has what the plugin says of it, or "".
  virtual Result<Object> from_text(std::string_view text) const = 0;
  // Whether its objects can leave their process, as bytes.
  virtual bool has_bytes() const = 0;
  // A failure begins with the name of the function.
  virtual Result<std::string> to_bytes(const void* object) const = 0;
  virtual Result<Object> from_bytes(std::string_view bytes) const = 0;
  // Whether an input of this type may read an entry of the type of that name.
  virtual bool reads(std::string_view name) const { return name == name_; }
  // Whether its objects are the bytes of objects of another process: PackedType.
  virtual bool is_packed() const { return false; }

 private:
  std::string name_;
};

// A reference to an object, or none.
class Object {
 public:
  Object() = default;
  // Takes over a reference that the caller has.
  Object(const ObjectType& type, void* object) : type_(&type), object_(object) {}
  Object(const Object& other) noexcept : type_(other.type_), object_(other.object_) {
    if (object_ != nullptr) type_->retain(object_);
  }
  Object(Object&& other) noexcept
      : type_(other.type_), object_(std::exchange(other.object_, nullptr)) {}
  Object& operator=(Object other) noexcept {
    std::swap(type_, other.type_);
    std::swap(object_, other.object_);
    return *this;
  }
  ~Object() {
    if (object_ != nullptr) type_->release(object_);
  }

  void* get() const { return object_; }
  const ObjectType* type() const { return type_; }
  bool operator==(const Object& other) const { return object_ == other.object_; }

 private:
  const ObjectType* type_ = nullptr;
  void* object_ = nullptr;
};

}  // namespace lockstep::host
