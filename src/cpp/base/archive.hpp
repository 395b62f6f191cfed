#pragma once

#include <Eigen/Core>
#include <cstring>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace pydart2 {

/// Numbers and texts on their way out of the engine or back into it. A function that visits everything once, with a way
/// to read and a way to write each, serves for both directions, so that nothing is saved that is not restored.
class Archive
{
public:
  enum class Way { out, in };

  /// Out of the engine.
  Archive() : way_(Way::out) {}

  /// Back into it.
  Archive(std::vector<std::string> texts, std::vector<double> numbers)
    : way_(Way::in), texts(std::move(texts)), numbers(std::move(numbers))
  {
  }

  bool is_in() const { return way_ == Way::in; }

  /// One number; written only where it differs, as many of the engine's setters throw caches away or warn.
  template <class Get, class Set>
  void number(Get get, Set set)
  {
    const double now = get();
    if (!is_in())
      numbers.push_back(now);
    else if (const double value = next_number(); std::memcmp(&now, &value, sizeof now) != 0)
      set(value);
  }

  /// A vector of a size that the model gives.
  template <class Get, class Set>
  void vector(Get get, Set set)
  {
    const auto now = get(); // of fixed size or not
    const auto size = static_cast<std::size_t>(now.size());
    if (!is_in()) {
      numbers.insert(numbers.end(), now.data(), now.data() + size);
      return;
    }
    if (numbers.size() - number_ < size)
      refuse();
    const double* values = numbers.data() + number_;
    number_ += size;
    if (size > 0 && std::memcmp(now.data(), values, size * sizeof(double)) != 0)
      set(Eigen::Map<const Eigen::VectorXd>(values, now.size()));
  }

  template <class Get, class Set>
  void text(Get get, Set set)
  {
    const std::string now = get();
    if (!is_in())
      texts.push_back(now);
    else if (text_ == texts.size())
      refuse();
    else if (const auto& value = texts[text_++]; value != now)
      set(value);
  }

  /// What a restored model must agree in.
  void same(const std::string& fact)
  {
    text([&] { return fact; }, [](const std::string&) { refuse(); });
  }

  /// How many of something follow: `now` on the way out, what was saved on the way in.
  std::size_t count(std::size_t now)
  {
    double value = static_cast<double>(now);
    number([&] { return static_cast<double>(now); }, [&](double saved) { value = saved; });
    if (!(value >= 0.0 && value <= 1e9))
      refuse();
    return static_cast<std::size_t>(value);
  }

  /// Whether a part follows that earlier versions did not save. It is saved only `if_any`, after its name.
  bool part(const std::string& name, bool if_any)
  {
    if (!is_in()) {
      if (if_any)
        texts.push_back(name);
      return if_any;
    }
    const bool follows = text_ < texts.size() && texts[text_] == name;
    text_ += follows ? 1 : 0;
    return follows;
  }

  /// Throws unless all that was saved has been taken.
  void finish() const
  {
    if (is_in() && (number_ != numbers.size() || text_ != texts.size()))
      refuse();
  }

  [[noreturn]] static void refuse()
  {
    throw Error(Kind::value, "what was saved is of another model: the world has other skeletons, bodies, joints or shapes");
  }

private:
  double next_number()
  {
    if (number_ == numbers.size())
      refuse();
    return numbers[number_++];
  }

  const Way way_;
  std::size_t number_ = 0, text_ = 0;

public:
  std::vector<std::string> texts;
  std::vector<double> numbers;
};

} // namespace pydart2
