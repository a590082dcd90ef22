// Functions that are called when something happens, each as long as its subscriber lives.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace BT {

template <class... Arguments>
class Signal {
 public:
  using CallableFunction = std::function<void(Arguments...)>;
  using Subscriber = std::shared_ptr<CallableFunction>;

  Subscriber subscribe(CallableFunction function) {
    auto subscriber = std::make_shared<CallableFunction>(std::move(function));
    subscribers_.emplace_back(subscriber);
    return subscriber;
  }
  void notify(Arguments... arguments) {
    for (std::size_t i = 0; i < subscribers_.size(); ++i) {  // one may subscribe another
      if (const Subscriber it = subscribers_[i].lock()) (*it)(arguments...);
    }
    subscribers_.erase(std::remove_if(subscribers_.begin(), subscribers_.end(),
                                      [](const auto& it) { return it.expired(); }),
                       subscribers_.end());
  }

 private:
  std::vector<std::weak_ptr<CallableFunction>> subscribers_;
};

}  // namespace BT
