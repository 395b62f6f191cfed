#include "recording.hpp"

namespace pydart2 {

void Recording::set_enabled(bool enabled)
{
  enabled_ = enabled;
  if (!enabled)
    clear();
}

void Recording::clear()
{
  frames_.clear();
  frames_.shrink_to_fit();
  first_ = 0;
  bytes_ = 0;
}

void Recording::add(Frame frame)
{
  bytes_ += frame.bytes();
  frames_.push_back(std::move(frame));
  drop_oldest();
}

const Frame* Recording::find(long index) const
{
  if (index < first_ || index >= num_frames())
    return nullptr;
  return &frames_[static_cast<std::size_t>(index - first_)];
}

void Recording::set_limit(std::size_t bytes)
{
  limit_ = bytes;
  drop_oldest();
}

void Recording::drop_oldest()
{
  while (bytes_ > limit_ && frames_.size() > 1) { // the newest frame always stays
    bytes_ -= frames_.front().bytes();
    frames_.pop_front();
    ++first_;
  }
}

} // namespace pydart2
