// `run --groot2`: Groot2 as a watcher of a run.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

struct Definition;
class Observer;
class RunControl;
struct Shape;

// Where Groot2 looks for a run.
constexpr std::string_view kGrootAddress = "127.0.0.1:1667";

// Listens already, but answers nobody yet.
class GrootListener {
 public:
  virtual ~GrootListener() = default;
  // Begins to answer, and shows the run that it observes; once. Clients may only look if `control`
  // is null. `print` shows a line to the person, from another thread.
  virtual std::unique_ptr<Observer> show(const Shape& shape, RunControl* control,
                                         std::function<void(const std::string& line)> print) = 0;
};

// `address` is the value of --groot2: a port, and implicitly the one after it. Says where it is,
// and warns when other machines can reach it. Refused if this lockstep knows no Groot2.
Result<std::unique_ptr<GrootListener>> listen_for_groot(const std::string& address,
                                                        const Definition& definition);

}  // namespace lockstep::host
