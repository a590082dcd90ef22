// The leaves of one run and their run context in a leafhost, with the values that their ports are
// bound to. A message requests each call, and another message answers it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "leaves/plugin/contract/call_sites.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/plugin/contract/workers.h"
#include "leaves/remote/shared_memory/host_log.h"
#include "leaves/remote/shared_memory/message.h"

namespace lockstep::host {

class ServedRun {
 public:
  ServedRun(const Descriptors& descriptors, HostLog& log) : descriptors_(descriptors), log_(log) {}

  // Executes the request, whose function has already been read. Returns false if it is invalid.
  bool answer(PluginFunction function, MessageReader& request, MessageWriter& answer);

 private:
  struct Object {
    std::uint32_t number;
    const lockstep_leaf_type* type;  // null: the run itself
    LeafSlot slot;
    LeafLog log;
    const CallSite* site;
    CallerRun run{.log = &log};
    std::optional<lockstep_caller> caller;
    PortTable ports;
    std::deque<std::string> entry_names;  // of its ports; none of them moves
  };
  std::unique_ptr<Object> make_object(std::uint32_t number, const char* who, RandomStream random);
  Object* create_run(MessageReader& request);
  Object* create_leaf(std::uint32_t number, MessageReader& request);
  Object* find(std::uint32_t number);
  bool read_ports(MessageReader& request, Object& leaf, std::span<const Parameter> declared);
  bool bind(BoundPort& port, std::uint32_t number, bool is_writable);
  bool read_entries(MessageReader& request);
  // An entry of the host.
  struct Mirror : Entry {
    const PackedType* objects = nullptr;  // null: its values are none
  };
  Mirror* entry(std::uint32_t number);
  // Returns the description of what it threw, or "" if it returned.
  std::string call(Object& object, PluginFunction function, std::uint64_t& result);
  std::uint64_t create(Object& object);
  std::uint64_t call_run(Object& object, PluginFunction function);
  std::uint64_t call_leaf(Object& object, PluginFunction function);
  std::uint64_t save(const lockstep_leaf_type& type, void* self);
  void write_entries(MessageWriter& answer) const;
  void perform(Object& object, PluginFunction function, MessageWriter& answer);
  void give_turns(Nanoseconds now, std::uint32_t turns);
  double factor_ = 1;         // of the call, if it tells a pace
  lockstep_cut cut_{};        // of the call, if it restores
  std::string restored_;      // likewise
  std::string kept_;          // what the call saves
  bool is_measured_ = false;  // there was much to carry, once

  const Descriptors& descriptors_;
  HostLog& log_;
  Workers workers_;
  LeafTime time_;
  std::optional<CallSites> sites_;  // of the leaves of the run
  std::unordered_map<std::uint32_t, std::unique_ptr<Object>> objects_;
  std::deque<Mirror> entries_;  // none of them moves
  std::unordered_map<const Entry*, std::uint32_t> numbers_;
  std::vector<Entry*> written_;  // in this call
};

}  // namespace lockstep::host
