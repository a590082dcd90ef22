// A thread that analyzes the newest texts, so that the editor is answered meanwhile.
#pragma once

#include <atomic>
#include <condition_variable>
#include <list>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "author/server/analysis.h"
#include "base/system/mutex.h"
#include "base/system/pipe.h"

namespace lockstep::host {

class AnalysisThread {
 public:
  AnalysisThread();
  // Waits for the analysis that is going on.
  ~AnalysisThread();
  AnalysisThread(const AnalysisThread&) = delete;
  AnalysisThread& operator=(const AnalysisThread&) = delete;

  // Takes the place of a job for the same file that has not begun.
  void post(AnalysisJob job);
  // Forgets the job of a file that was closed.
  void forget(const std::string& uri);
  // Can be read when take() has something.
  int wakes() const { return wake_.reading.number(); }
  std::vector<Analysis> take();

 private:
  void work();
  enum class Wait : bool { No, Yes };
  std::optional<AnalysisJob> next(Wait wait);
  void finish(std::list<Analysis>& unfinished);
  void deliver(Analysis analysis);
  void wake();

  Pipe wake_;
  Mutex mutex_;
  std::condition_variable changed_;
  std::list<AnalysisJob> jobs_ LOCKSTEP_GUARDED_BY(mutex_);
  std::vector<Analysis> done_ LOCKSTEP_GUARDED_BY(mutex_);
  std::atomic<int> has_more_ = 0;  // the search over all behaviors gives way to other jobs
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace lockstep::host
