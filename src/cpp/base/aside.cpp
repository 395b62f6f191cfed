#include "base/aside.hpp"

#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <exception>
#include <mutex>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "base/errors.hpp"
#include "base/interrupt.hpp"
#include "base/messages.hpp"

namespace pydart2 {

namespace {

struct Job
{
  std::function<void()> work;
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::exception_ptr thrown;
  std::vector<messages::Message> said;
};

void live(const std::shared_ptr<Job>& job)
{
  const messages::Listening listening;
  std::exception_ptr thrown;
  try {
    job->work();
  } catch (...) {
    thrown = std::current_exception();
  }
  job->work = nullptr;
  const std::lock_guard<std::mutex> lock(job->mutex);
  job->thrown = std::move(thrown);
  job->said = messages::take();
  job->done = true;
  job->changed.notify_all();
}

/// In a thread that gets no signals.
std::thread start(const std::shared_ptr<Job>& job)
{
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  ++threads_inside;
  std::thread thread;
  try {
    thread = std::thread([job = std::shared_ptr<Job>(job)]() mutable {
      live(job);
      job.reset();
      --threads_inside;
    });
  } catch (const std::system_error&) { // no more threads
    --threads_inside;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

void check_time(std::thread& thread, double seconds)
{
  clockid_t clock{};
  timespec used{};
  if (pthread_getcpuclockid(thread.native_handle(), &clock) != 0 || clock_gettime(clock, &used) != 0
      || static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9 < seconds)
    return;
  std::ostringstream text;
  text << "the engine does not finish it in " << seconds << " s of processor time; load_seconds= waits longer";
  throw Error(Kind::load, text.str());
}

void wait(Job& job, std::thread& thread, double seconds)
{
  std::unique_lock<std::mutex> lock(job.mutex);
  while (!job.changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return job.done; })) {
    lock.unlock();
    Interruptible::poll();
    check_time(thread, seconds);
    lock.lock();
  }
}

} // namespace

void run_aside(double seconds, std::function<void()> work)
{
  const auto job = std::make_shared<Job>();
  job->work = std::move(work);
  auto thread = start(job);
  if (!thread.joinable())
    return job->work();
  try {
    wait(*job, thread, seconds);
  } catch (...) {
    thread.detach();
    throw;
  }
  thread.join();
  messages::give(std::move(job->said));
  if (job->thrown)
    std::rethrow_exception(job->thrown);
}

} // namespace pydart2
