#include "base/core/plugin_exception.h"

#include <unwind.h>

#include <fmt/format.h>

namespace lockstep::host {
namespace {

std::string describe(const char* what) {
  if (what == nullptr) return "threw an exception whose what() is NULL";
  if (*what == '\0') return "threw an exception whose what() is empty";
  return fmt::format("threw an exception: {}", Shortened(what).text());
}

}  // namespace

std::string describe_exception() {
  try {
    throw;
  } catch (const PluginException& exception) {
    return exception.what();
  } catch (const std::exception& exception) {
    return describe(exception.what());
  } catch (...) {
    return "threw an exception that is not a std::exception";
  }
}

void ready_to_catch() {
  _Unwind_Backtrace([](_Unwind_Context*, void*) { return _URC_END_OF_STACK; }, nullptr);
}

}  // namespace lockstep::host
