#include "base/parallel.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/fork.hpp"
#include "base/messages.hpp"

namespace pydart2 {

namespace {

/// A thread that sleeps between its jobs, until the process ends.
class Worker
{
public:
  Worker() : thread_(&Worker::live, this) { thread_.detach(); }

  void begin(std::function<void()> job)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    job_ = std::move(job);
    changed_.notify_all();
  }

  void wait()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !job_; });
  }

private:
  void live()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return static_cast<bool>(job_); });
      lock.unlock();
      job_();
      lock.lock();
      job_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  std::thread thread_;
};

/// Workers without a job. Those of the parent process are not in a child.
class Pool
{
public:
  /// As many as there are to be had, at most `count`.
  std::vector<Worker*> take(std::size_t count)
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(process_, getpid()) != getpid())
      idle_.clear();
    const auto kept = idle_.size() - std::min(idle_.size(), count);
    std::vector<Worker*> taken(idle_.begin() + static_cast<std::ptrdiff_t>(kept), idle_.end());
    idle_.resize(kept);
    try {
      while (taken.size() < count)
        taken.push_back(new Worker);
    } catch (const std::system_error&) { // no more threads: those that there are do it
    }
    return taken;
  }

  void give_back(const std::vector<Worker*>& workers)
  {
    const std::lock_guard lock(mutex_);
    idle_.insert(idle_.end(), workers.begin(), workers.end());
  }

private:
  HeldOverFork<std::mutex> mutex_{ForkOrder::innermost};
  std::vector<Worker*> idle_;
  pid_t process_ = getpid();
};

auto& pool = *new Pool; // for ever: so do its threads

thread_local bool within_a_call = false;

} // namespace

void parallel_for(std::size_t count, std::size_t num_threads, const std::function<void(std::size_t)>& work)
{
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown(count);
  const auto take_turns = [&] {
    const bool was_within = std::exchange(within_a_call, true);
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
    within_a_call = was_within;
  };
  const std::size_t wanted = within_a_call ? 1 : std::min(num_threads, count);
  const auto workers = wanted > 1 ? pool.take(wanted - 1) : std::vector<Worker*>();
  std::vector<std::vector<messages::Message>> said(workers.size());
  for (std::size_t i = 0; i < workers.size(); ++i)
    workers[i]->begin([&take_turns, &said_here = said[i]] {
      const messages::Listening listening;
      take_turns();
      said_here = messages::take();
    });
  take_turns();
  for (auto* worker : workers)
    worker->wait();
  if (!workers.empty())
    pool.give_back(workers);
  for (auto& messages : said)
    messages::give(std::move(messages));
  for (const auto& exception : thrown)
    if (exception)
      std::rethrow_exception(exception);
}

} // namespace pydart2
