#pragma once

#include <string>
#include <utility>
#include <vector>

/// What the engine prints during our calls, on std::cout and std::cerr, is kept for Python's logging. What other code
/// prints goes where it went before.
namespace pydart2::messages {

/// As in Python's logging.
enum class Level { debug = 10, info = 20, warning = 30, error = 40 };

struct Message
{
  Level level;
  std::string text;
};

/// Puts itself in front of std::cout and std::cerr, once; takes itself away when the process ends.
void install();

/// Every call of ours sets and reads them: __thread and initial-exec make that one instruction each.
struct Flags
{
  bool listening, waiting;
};
extern __thread Flags flags __attribute__((tls_model("initial-exec"), visibility("hidden")));

/// While one is alive, what this thread prints is kept.
class Listening
{
public:
  Listening() : outer_(flags.listening) { flags.listening = true; }
  ~Listening() { flags.listening = outer_; }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

private:
  bool outer_;
};

/// Whether take() would give anything.
inline bool any()
{
  return flags.waiting;
}

/// The messages that this thread's calls left, oldest first. Of one that repeats (digits apart), the first ten are
/// there, then the 100th, the 1000th, ..., which say so.
std::vector<Message> take();

/// Adds to this thread's messages those that another thread took while it worked for this one.
void give(std::vector<Message> messages);

/// What is printed while one is alive is lost: the engine's warnings about what is meant so.
class Ignoring
{
public:
  Ignoring() : before_(take()) {}
  ~Ignoring()
  {
    take();
    give(std::move(before_));
  }
  Ignoring(const Ignoring&) = delete;
  Ignoring& operator=(const Ignoring&) = delete;

private:
  const Listening listening_;
  std::vector<Message> before_;
};

/// The warnings and errors since the last take(), one after another, repeats too: the reason why a parser gave up.
std::string problems();

/// Counts repeats from zero again.
void forget();

} // namespace pydart2::messages
