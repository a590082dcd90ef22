#include "leaves/remote/remote_plugin.h"

#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

void* create_run(const lockstep_host* /*host*/, const lockstep_caller* caller) {
  return static_cast<const HostedPlugin*>(caller->run->plugin)
      ->remote->begin_run(*caller)
      .release();
}

void destroy_run(void* context) {
  const std::unique_ptr<RemoteRun> run(static_cast<RemoteRun*>(context));
  run->end();
}

void* create(const lockstep_host* /*host*/, const lockstep_caller* caller, void* run) {
  return static_cast<RemoteRun*>(run)->create(*caller).release();
}

void destroy(void* self) {
  const std::unique_ptr<RemoteLeaf> leaf(static_cast<RemoteLeaf*>(self));
  leaf->end();
}

template <auto kMember, class... Given>
auto call(void* leaf, Given... given) {
  return (static_cast<RemoteLeaf*>(leaf)->*kMember)(given...);
}

}  // namespace

RemoteLeaf::RemoteLeaf(const lockstep_caller& caller) : caller_(caller) {
  if (caller.time->processes != nullptr) caller.time->processes->add(caller.node, *this);
}

RemoteLeaf::~RemoteLeaf() {
  if (caller_.time->processes != nullptr) caller_.time->processes->remove(*this);
}

void RemoteLeaf::fail(const std::string& why) const {
  host_table().set_error(&caller_, why.c_str());
}

const lockstep_plugin& proxy_plugin() {
  static constexpr lockstep_plugin kPlugin = [] {
    lockstep_plugin plugin{};
    plugin.abi_major = LOCKSTEP_ABI_MAJOR;
    plugin.abi_minor = LOCKSTEP_ABI_MINOR;
    plugin.struct_size = sizeof plugin;
    plugin.create_run = create_run;
    plugin.destroy_run = destroy_run;
    return plugin;
  }();
  return kPlugin;
}

const lockstep_leaf_type& proxy_leaf_type() {
  static constexpr lockstep_leaf_type kType = [] {
    lockstep_leaf_type type{};
    type.struct_size = sizeof type;
    type.create = create;
    type.destroy = destroy;
    type.start = call<&RemoteLeaf::start>;
    type.start_unreset = call<&RemoteLeaf::start_unreset>;
    type.tick = call<&RemoteLeaf::tick>;
    type.halt = call<&RemoteLeaf::halt>;
    type.pause = call<&RemoteLeaf::pause>;
    type.resume = call<&RemoteLeaf::resume>;
    type.progress = call<&RemoteLeaf::progress>;
    type.set_pace = call<&RemoteLeaf::set_pace, double>;
    type.save = call<&RemoteLeaf::save, void*, std::size_t>;
    type.restore = call<&RemoteLeaf::restore, const void*, std::size_t, const lockstep_cut*>;
    return type;
  }();
  return kType;
}

}  // namespace lockstep::host
