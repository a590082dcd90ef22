#include "author/server/analysis_thread.h"

#include <unistd.h>

#include <array>
#include <utility>

#include "base/system/own_thread.h"

namespace lockstep::host {

AnalysisThread::AnalysisThread() {
  wake_.open();
  fcntl(wake_.reading.number(), F_SETFL, O_NONBLOCK);
  fcntl(wake_.writing.number(), F_SETFL, O_NONBLOCK);
  thread_ = own_thread([this] {
    try {
      work();
    } catch (...) {
      wake();
      throw;  // to take()
    }
  });
}

AnalysisThread::~AnalysisThread() {
  {
    const Lock lock(mutex_);
    is_over_ = true;
    has_more_ = 1;
    jobs_.clear();
  }
  changed_.notify_one();
  thread_.join();
}

void AnalysisThread::post(AnalysisJob job) {
  forget(job.uri);
  {
    const Lock lock(mutex_);
    has_more_ = 1;
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
  rethrow_thread_failure();
  const Lock lock(mutex_);
  return std::exchange(done_, {});
}

void AnalysisThread::work() {
  PluginCache cache;
  std::list<Analysis> unfinished;
  while (true) {
    std::optional<AnalysisJob> job = next(unfinished.empty() ? Wait::Yes : Wait::No);
    if (is_over_) return;
    if (job) {
      std::erase_if(unfinished, [&](const Analysis& it) { return it.uri == job->uri; });
      Analysis analysis = analyze(*job, cache);
      if (!analysis.is_whole) unfinished.push_back(analysis);
      deliver(std::move(analysis));
    } else if (!unfinished.empty()) {
      finish(unfinished);
    }
  }
}

// Nothing if there is none.
std::optional<AnalysisJob> AnalysisThread::next(Wait wait) {
  Lock lock(mutex_);
  while (wait == Wait::Yes && jobs_.empty() && !is_over_) lock.wait(changed_);
  if (jobs_.empty()) return std::nullopt;
  AnalysisJob job = std::move(jobs_.front());
  jobs_.pop_front();
  has_more_ = jobs_.empty() ? 0 : 1;
  return job;
}

// Gives way to other jobs; then it is begun again.
void AnalysisThread::finish(std::list<Analysis>& unfinished) {
  Analysis analysis = unfinished.front();
  complete(analysis, [this] { return has_more_.load(); });
  if (has_more_ != 0) return;
  unfinished.pop_front();
  deliver(std::move(analysis));
}

void AnalysisThread::deliver(Analysis analysis) {
  const Lock lock(mutex_);
  done_.push_back(std::move(analysis));
  wake();
}

// A full pipe wakes, too.
void AnalysisThread::wake() {
  [[maybe_unused]] const auto written = ::write(wake_.writing.number(), "", 1);
}

}  // namespace lockstep::host
