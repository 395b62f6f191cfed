#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace pydart2 {

/// One frame: the states of all skeletons, one after another ([q, dq] each), and the contacts (contact.hpp).
struct Frame
{
  std::vector<double> state;
  std::vector<double> contacts;
  int layout = 0; ///< WorldRecord::layout() when it was made.

  std::size_t bytes() const { return sizeof(Frame) + sizeof(double) * (state.capacity() + contacts.capacity()); }
};

/// The frames since the last reset, up to a memory limit; the oldest go first.
class Recording
{
public:
  void set_enabled(bool enabled);
  bool enabled() const { return enabled_; }

  void clear();
  void add(Frame frame);

  /// Frames since the last clear(), those that are gone included.
  long num_frames() const { return first_ + static_cast<long>(frames_.size()); }

  /// Index of the oldest frame that is kept.
  long first_frame() const { return first_; }

  /// The frame, or null if it is gone or was never there.
  const Frame* find(long index) const;

  std::size_t bytes() const { return bytes_; }
  std::size_t limit() const { return limit_; }
  void set_limit(std::size_t bytes);

private:
  void drop_oldest();

  bool enabled_ = false;
  std::deque<Frame> frames_;
  long first_ = 0;
  std::size_t bytes_ = 0;
  std::size_t limit_ = std::size_t{64} << 20;
};

} // namespace pydart2
