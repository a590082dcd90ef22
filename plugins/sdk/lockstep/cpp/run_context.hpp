// The object that the leaves of one run share, such as a simulated world: any class of the plugin,
// made with the run and gone with it. Included by lockstep/leaf.hpp.
#pragma once

#include <stdexcept>
#include <type_traits>

#include "caller.hpp"

namespace lockstep {
inline namespace sdk1 {

// One run, for a context whose constructor takes a Run& because it wants the host's services. Lives
// as long as the context.
class Run : public Services {
 public:
  explicit Run(const detail::Caller& caller) : Services(caller) {}
};

namespace detail {

template <class Context>
inline constexpr char kContextType = 0;

// The context behind the void* of the C contract, with the type that it was made as.
struct ContextBase {
  const void* type;
  Caller caller;
};

template <class Context>
struct ContextHolder : ContextBase {
  explicit ContextHolder(const Caller& of)
      : ContextBase{&kContextType<Context>, of}, run(of), value(make(run)) {}

  static ContextHolder& from(void* context) {
    auto* base = static_cast<ContextBase*>(context);
    if (!base || base->type != &kContextType<Context>) {
      throw std::logic_error("the plugin declares no run context of this type");
    }
    return *static_cast<ContextHolder*>(base);
  }

  // The functions of the C table.
  static void* create(const lockstep_host* host, const lockstep_caller* id) {
    const Caller caller{host, id};
    return guarded(caller, static_cast<void*>(nullptr),
                   [&]() -> void* { return static_cast<ContextBase*>(new ContextHolder(caller)); });
  }
  static void destroy(void* context) {
    if (!context) return;
    auto& holder = *static_cast<ContextHolder*>(static_cast<ContextBase*>(context));
    const Caller caller = holder.caller;
    guarded_end(caller, [&] { delete &holder; });
  }

  Run run;
  Context value;

 private:
  static Context make(Run& run) {
    if constexpr (std::is_constructible_v<Context, Run&>) {
      return Context(run);
    } else {
      return Context();
    }
  }
};

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
