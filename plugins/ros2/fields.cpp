#include "fields.hpp"

#include <rosidl_typesupport_introspection_c/field_types.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

namespace ros2 {
namespace {

using Kind = Field::Kind;

struct Scalar {
  Kind kind, list;
  double min = 0, max = 0;
};

template <class T>
Scalar whole() {
  // A port is an int of 64 bits, so what is larger than that is not reached.
  if (sizeof(T) < 8) {
    return {Kind::Int, Kind::IntList, double(std::numeric_limits<T>::min()),
            double(std::numeric_limits<T>::max())};
  }
  return {Kind::Int, Kind::IntList, 0, std::numeric_limits<T>::is_signed ? 0 : HUGE_VAL};
}

// Nothing: no port can carry it.
std::optional<Scalar> scalar_of(std::uint8_t type) {
  switch (type) {
    case rosidl_typesupport_introspection_c__ROS_TYPE_FLOAT:
    case rosidl_typesupport_introspection_c__ROS_TYPE_DOUBLE:
      return Scalar{Kind::Double, Kind::DoubleList};
    case rosidl_typesupport_introspection_c__ROS_TYPE_BOOLEAN:
      return Scalar{Kind::Bool, Kind::BoolList};
    case rosidl_typesupport_introspection_c__ROS_TYPE_STRING:
      return Scalar{Kind::String, Kind::StringList};
    case rosidl_typesupport_introspection_c__ROS_TYPE_CHAR:
    case rosidl_typesupport_introspection_c__ROS_TYPE_OCTET:
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT8:
      return whole<std::uint8_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT8:
      return whole<std::int8_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT16:
      return whole<std::uint16_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT16:
      return whole<std::int16_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT32:
      return whole<std::uint32_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT32:
      return whole<std::int32_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT64:
      return whole<std::uint64_t>();
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT64:
      return whole<std::int64_t>();
    default:
      return std::nullopt;
  }
}

bool is_builtin(const Members& members, const char* name) {
  return std::strcmp(members.message_namespace_, "builtin_interfaces__msg") == 0 &&
         std::strcmp(members.message_name_, name) == 0;
}

class FieldList {
 public:
  explicit FieldList(std::vector<Field>& fields) : fields_(fields) {}

  void add_object(const Members& members, const std::string& path, std::size_t at) {
    Field& field = fields_.emplace_back(Field{path, Kind::Object, at, nullptr});
    field.message = &members;
  }

  // With `rows`, these are the members of a message in that sequence.
  void add(const Members& members, const std::string& prefix, std::size_t offset,
           const std::shared_ptr<const Rows>& rows) {
    for (std::uint32_t i = 0; i < members.member_count_; ++i) {
      const Member& member = members.members_[i];
      if (std::strcmp(member.name_, "structure_needs_at_least_one_member") == 0) continue;
      const std::string path = prefix + member.name_;
      const std::size_t at = offset + member.offset_;
      if (const auto scalar = scalar_of(member.type_id_)) {
        const bool is_list = member.is_array_ || rows != nullptr;
        fields_.push_back({path, is_list ? scalar->list : scalar->kind, at, &member, scalar->min,
                           scalar->max, rows});
      } else if (member.type_id_ == rosidl_typesupport_introspection_c__ROS_TYPE_MESSAGE) {
        add_message(member, path, at, rows);
      }
    }
  }

 private:
  void add_message(const Member& member, const std::string& path, std::size_t at,
                   const std::shared_ptr<const Rows>& rows) {
    const Members& members = members_of(member);
    if (!member.is_array_) {
      if (rows == nullptr && is_builtin(members, "Time")) {
        fields_.push_back({path, Kind::Time, at, nullptr});
      } else if (rows == nullptr && is_builtin(members, "Duration")) {
        fields_.push_back({path, Kind::Duration, at, nullptr});
      } else if (rows == nullptr) {
        add_object(members, path, at);
      }
      add(members, path + ".", at, rows);
    } else if (rows == nullptr) {
      fields_.push_back({path, Kind::Messages, at, &member});
      add(members, path + ".", 0, std::make_shared<const Rows>(Rows{path, at, &member}));
    }
  }

  std::vector<Field>& fields_;
};

}  // namespace

std::vector<Field> fields_of(const Members& members, std::size_t offset) {
  std::vector<Field> fields;
  FieldList list(fields);
  list.add_object(members, "", offset);
  list.add(members, "", offset, nullptr);
  return fields;
}

const Field* find_field(const std::vector<Field>& fields, const std::string& path) {
  for (const Field& field : fields) {
    if (field.path == path) return &field;
  }
  return nullptr;
}

}  // namespace ros2
