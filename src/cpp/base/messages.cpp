#include "base/messages.hpp"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <streambuf>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/fork.hpp"

namespace pydart2::messages {

namespace {

constexpr std::size_t max_problems = 2000; ///< characters
constexpr std::size_t max_kinds = 1000;    ///< different messages that are counted

struct Prefix
{
  std::string_view text;
  Level level;
};

/// How DART (dtdbg, dtmsg, dtwarn, dterr) and urdfdom begin a message.
constexpr Prefix prefixes[] = {{"Debug", Level::debug},     {"Msg", Level::info},     {"Warning:", Level::warning},
                               {"Warning", Level::warning}, {"Error:", Level::error}, {"Error", Level::error}};

/// Without "\033[1;31m" and the like.
std::string without_colours(std::string_view line)
{
  std::string plain;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '\033')
      i = std::min(line.find('m', i), line.size());
    else
      plain += line[i];
  return plain;
}

std::string_view trimmed(std::string_view text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.remove_suffix(1);
  return text;
}

/// How often each message came, over all threads.
class Counts
{
public:
  long add(std::string text)
  {
    text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }), text.end());
    const std::lock_guard lock(mutex_);
    if (counts_.size() >= max_kinds)
      counts_.clear();
    return ++counts_[std::move(text)];
  }

  void clear()
  {
    const std::lock_guard lock(mutex_);
    counts_.clear();
  }

private:
  HeldOverFork<std::mutex> mutex_{ForkOrder::innermost};
  std::unordered_map<std::string, long> counts_;
};

Counts counts;

/// What a detector says of a shape that it does not have, when its contacts are found without it all the same
/// (collision/missing_pairs.hpp).
bool is_mended(std::string_view text)
{
  const auto has = [&](std::string_view part) { return text.find(part) != std::string_view::npos; };
  return (has("unsupported shape type") || has("not supported by DARTCollisionDetector")
          || has("PlaneShape is not supported by FCL")) && !has("SoftMeshShape");
}

bool is_power_of_ten(long count)
{
  while (count % 10 == 0)
    count /= 10;
  return count == 1;
}

/// One thread's messages.
class Inbox
{
public:
  void write(Level level, std::string_view text)
  {
    auto& line = level == Level::info ? out_ : err_;
    for (auto end = text.find('\n'); end != text.npos; end = text.find('\n')) {
      line += text.substr(0, end);
      add_line(level, std::exchange(line, {}));
      text.remove_prefix(end + 1);
    }
    line += text;
  }

  /// Ends the message that is being written.
  void finish()
  {
    for (const auto& [level, line] : {std::pair(Level::info, &out_), std::pair(Level::warning, &err_)})
      if (!line->empty())
        add_line(level, std::exchange(*line, {}));
    if (is_mended(message_.text))
      message_ = {};
    if (message_.text.empty())
      return;
    if (message_.level >= Level::warning && problems_.size() < max_problems)
      problems_ += (problems_.empty() ? "" : "; ") + message_.text;
    const long count = counts.add(message_.text);
    if (count > 10 && is_power_of_ten(count))
      message_.text += " (" + std::to_string(count) + " times so far)";
    if (count <= 10 || is_power_of_ten(count))
      done_.push_back(std::move(message_));
    message_ = {};
  }

  const std::string& problems() const { return problems_; }

  std::vector<Message> take()
  {
    problems_.clear();
    return std::exchange(done_, {});
  }

  void give(std::vector<Message> messages)
  {
    finish();
    std::move(messages.begin(), messages.end(), std::back_inserter(done_));
  }

private:
  /// A line that begins as messages do ends the one before; any other goes on with it.
  void add_line(Level level, const std::string& raw)
  {
    const std::string plain = without_colours(raw);
    const auto line = trimmed(plain);
    const auto* prefix = std::find_if(std::begin(prefixes), std::end(prefixes), [&](const Prefix& p) {
      return line.substr(0, p.text.size()) == p.text;
    });
    if (prefix != std::end(prefixes)) {
      finish();
      message_ = {prefix->level, std::string(trimmed(line.substr(prefix->text.size())))};
    } else if (message_.text.empty()) {
      message_ = {level, std::string(line)};
    } else if (!line.empty()) {
      message_.text += "\n" + std::string(line);
    }
  }

  std::string out_, err_; ///< Lines not ended yet.
  Message message_{};     ///< Message not ended yet.
  std::vector<Message> done_;
  std::string problems_;
};

Inbox& inbox()
{
  static thread_local Inbox inbox;
  return inbox;
}

/// In front of a stream's own buffer: takes what a listening thread prints, passes on the rest.
class Tap : public std::streambuf
{
public:
  Tap(std::ostream& stream, Level level) : stream_(stream), behind_(stream.rdbuf(this)), level_(level) {}

  ~Tap() override
  {
    if (stream_.rdbuf() == this)
      stream_.rdbuf(behind_);
  }

protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override
  {
    if (!flags.listening)
      return behind_->sputn(text, size);
    inbox().write(level_, {text, static_cast<std::size_t>(size)});
    flags.waiting = true;
    return size;
  }

  int_type overflow(int_type c) override
  {
    const char text = traits_type::to_char_type(c);
    if (traits_type::eq_int_type(c, traits_type::eof()))
      return traits_type::not_eof(c);
    return xsputn(&text, 1) == 1 ? c : traits_type::eof();
  }

  int sync() override { return flags.listening ? 0 : behind_->pubsync(); }

private:
  std::ostream& stream_;
  std::streambuf* behind_;
  Level level_;
};

} // namespace

__thread Flags flags;

void install()
{
  static Tap out(std::cout, Level::info);
  static Tap err(std::cerr, Level::warning);
}

std::vector<Message> take()
{
  flags.waiting = false;
  inbox().finish();
  return inbox().take();
}

void give(std::vector<Message> messages)
{
  flags.waiting |= !messages.empty();
  inbox().give(std::move(messages));
}

std::string problems()
{
  if (!flags.waiting)
    return {};
  inbox().finish();
  return inbox().problems();
}

void forget()
{
  counts.clear();
}

} // namespace pydart2::messages
