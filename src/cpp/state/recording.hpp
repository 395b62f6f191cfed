#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>

namespace pydart2 {

/// One frame: the states of all skeletons, one after another ([q, dq] each), the contacts (contact.hpp), and the indices
/// of the skeletons that slept.
struct Frame
{
  double* state;
  std::size_t num_states, num_contacts, num_sleepers;
  int layout; ///< WorldRecord::layout() when it was made.
  double time;

  double* contacts() const { return state + num_states; }
  double* sleepers() const;
  std::size_t size() const; ///< Of the numbers.
  std::size_t bytes() const { return sizeof(Frame) + sizeof(double) * size(); }
};

/// The frames since the last reset, up to a memory limit; the oldest go first. Their numbers are one growing array, in
/// pieces that stay where they are.
class Recording
{
public:
  void set_enabled(bool enabled);
  bool enabled() const { return enabled_; }

  void clear();

  /// A frame more, whose numbers are still to be written.
  const Frame& add(
      std::size_t num_states, std::size_t num_contacts, std::size_t num_sleepers, int layout, double time);

  /// Frames since the last clear(), those that are gone included.
  long num_frames() const { return first_ + static_cast<long>(frames_.size()); }

  /// Index of the oldest frame that is kept.
  long first_frame() const { return first_; }

  /// The frame, or null if it is gone or was never there.
  const Frame* find(long index) const;

  /// Changes the contacts of all frames, row by row.
  void each_contact(const std::function<void(double*)>& change);

  /// A skeleton has gone: those that slept after it have other indices now, and it has -1.
  void forget_sleeper(int index);

  std::size_t bytes() const { return bytes_; }
  std::size_t limit() const { return limit_; }
  void set_limit(std::size_t bytes);

private:
  struct Piece
  {
    std::unique_ptr<double[]> numbers;
    std::size_t capacity, size = 0;
    std::size_t num_frames = 0; ///< That are kept.
  };

  void drop_oldest();

  bool enabled_ = false;
  std::deque<Piece> pieces_;
  std::deque<Frame> frames_;
  long first_ = 0;
  std::size_t bytes_ = 0;
  std::size_t limit_ = std::size_t{64} << 20;
};

} // namespace pydart2
