#include "authoring/server/analysis_thread.h"

#include <unistd.h>

#include <array>
#include <utility>

namespace lockstep::host {

AnalysisThread::AnalysisThread() {
  wake_.open();
  fcntl(wake_.reading.number(), F_SETFL, O_NONBLOCK);
  fcntl(wake_.writing.number(), F_SETFL, O_NONBLOCK);
  thread_ = std::thread([this] { work(); });
}

AnalysisThread::~AnalysisThread() {
  {
    const Lock lock(mutex_);
    is_over_ = true;
    jobs_.clear();
  }
  changed_.notify_one();
  thread_.join();
}

void AnalysisThread::post(AnalysisJob job) {
  forget(job.uri);
  {
    const Lock lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
}

void AnalysisThread::forget(const std::string& uri) {
  const Lock lock(mutex_);
  jobs_.remove_if([&](const AnalysisJob& it) { return it.uri == uri; });
}

std::vector<Analysis> AnalysisThread::take() {
  std::array<char, 64> bytes;
  while (::read(wakes(), bytes.data(), bytes.size()) > 0) {
  }
  const Lock lock(mutex_);
  return std::exchange(done_, {});
}

void AnalysisThread::work() {
  PluginCache cache;
  Lock lock(mutex_);
  while (true) {
    while (jobs_.empty() && !is_over_) lock.wait(changed_);
    if (is_over_) return;
    const AnalysisJob job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    Analysis analysis = analyze(job, cache);
    lock.lock();
    done_.push_back(std::move(analysis));
    // A full pipe wakes, too.
    [[maybe_unused]] const auto written = ::write(wake_.writing.number(), "", 1);
  }
}

}  // namespace lockstep::host
