// Functions that are called when something happens, each as long as its subscriber lives.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
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
    const std::lock_guard<std::mutex> lock(mutex_);
    subscribers_.emplace_back(subscriber);
    return subscriber;
  }
  // From any thread. What is called may subscribe others.
  void notify(Arguments... arguments) {
    for (const Subscriber& it : living()) (*it)(arguments...);
  }

 private:
  std::vector<Subscriber> living() {
    std::vector<Subscriber> all;
    const std::lock_guard<std::mutex> lock(mutex_);
    subscribers_.erase(std::remove_if(subscribers_.begin(), subscribers_.end(),
                                      [&all](const auto& it) {
                                        Subscriber living = it.lock();
                                        if (living == nullptr) return true;
                                        all.push_back(std::move(living));
                                        return false;
                                      }),
                       subscribers_.end());
    return all;
  }

  std::mutex mutex_;
  std::vector<std::weak_ptr<CallableFunction>> subscribers_;
};

}  // namespace BT
