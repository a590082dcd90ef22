// The table that a leaf may read without a call as long as it exists: lockstep_lasting.
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

// Null: it has another type, or no value.
template <class T>
const void* constant_of(const BoundPort& port) {
  return std::get_if<T>(port.read);
}

const void* constant(const lockstep_caller* caller, std::uint32_t port, lockstep_type type) {
  const BoundPort* const it = port_of(*caller, port);
  if (it == nullptr || it->parameter == nullptr) return nullptr;
  if (!it->entry.empty() || it->read == nullptr || it->must_be_checked()) return nullptr;
  switch (type) {
    case LOCKSTEP_BOOL:
      return constant_of<bool>(*it);
    case LOCKSTEP_INT:
      return constant_of<std::int64_t>(*it);
    case LOCKSTEP_DOUBLE:
      return constant_of<double>(*it);
    default:
      return nullptr;
  }
}

// A value out of a port's limits is an error also where no entry is bound to it.
bool is_set(const lockstep_caller* caller, std::uint32_t port) {
  const BoundPort* const it = port_of(*caller, port);
  return it == nullptr || it->write != nullptr || it->has_limits;
}

}  // namespace

const lockstep_lasting& lasting_table() {
  static constexpr lockstep_lasting kTable{
      .struct_size = sizeof(lockstep_lasting), .constant = constant, .is_set = is_set};
  return kTable;
}

}  // namespace lockstep::host
