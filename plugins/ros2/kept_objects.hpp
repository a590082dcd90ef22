// The objects that were made of a message. While the message is the same, so are they: who looks
// whether an entry has changed sees that it has not.
#pragma once

#include <map>
#include <memory>

#include "field_values.hpp"
#include "message.hpp"
#include "message_object.hpp"

namespace ros2 {

class KeptObjects {
 public:
  void forget() { made_.clear(); }

  // As write_port for each.
  void write(const lockstep_host& host, const lockstep_caller* caller, const FieldPorts& ports,
             const Message& message) {
    for (const auto& [port, field] : ports) {
      const PortOf to{&host, caller, port};
      if (field->kind != Field::Kind::Object) {
        write_port(to, *field, message.get());
        continue;
      }
      Owned& object = made_[port];
      if (object == nullptr) object = Owned(object_in(*field, message.get()));
      if (object != nullptr) host.set_object(caller, port, object.get());
    }
  }

 private:
  struct Release {
    void operator()(void* object) const { release_object(object); }
  };
  using Owned = std::unique_ptr<void, Release>;
  std::map<std::uint32_t, Owned> made_;  // by port
};

}  // namespace ros2
