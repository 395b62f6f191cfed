#include "state/recording.hpp"

#include <algorithm>

#include "state/contact.hpp"

namespace pydart2 {

namespace {

constexpr std::size_t piece_size = 8192; // numbers

} // namespace

double* Frame::sleepers() const
{
  return contacts() + num_contacts * contact_columns;
}

std::size_t Frame::size() const
{
  return num_states + num_contacts * contact_columns + num_sleepers;
}

void Recording::set_enabled(bool enabled)
{
  enabled_ = enabled;
  if (!enabled)
    clear();
}

void Recording::clear()
{
  pieces_.clear();
  pieces_.shrink_to_fit();
  frames_.clear();
  frames_.shrink_to_fit();
  first_ = 0;
  bytes_ = 0;
}

const Frame& Recording::add(
    std::size_t num_states, std::size_t num_contacts, std::size_t num_sleepers, int layout, double time)
{
  Frame frame{nullptr, num_states, num_contacts, num_sleepers, layout, time};
  if (pieces_.empty() || pieces_.back().capacity < pieces_.back().size + frame.size()) {
    const std::size_t capacity = std::max(piece_size, frame.size());
    pieces_.push_back({std::unique_ptr<double[]>(new double[capacity]), capacity}); // not make_unique, which clears them
  }
  auto& piece = pieces_.back();
  frame.state = piece.numbers.get() + piece.size;
  piece.size += frame.size();
  ++piece.num_frames;
  bytes_ += frame.bytes();
  frames_.push_back(frame);
  drop_oldest();
  return frames_.back();
}

const Frame* Recording::find(long index) const
{
  if (index < first_ || index >= num_frames())
    return nullptr;
  return &frames_[static_cast<std::size_t>(index - first_)];
}

void Recording::each_contact(const std::function<void(double*)>& change)
{
  for (const auto& frame : frames_)
    for (std::size_t i = 0; i < frame.num_contacts; ++i)
      change(frame.contacts() + i * contact_columns);
}

void Recording::forget_sleeper(int index)
{
  for (const auto& frame : frames_)
    for (double* sleeper = frame.sleepers(); sleeper != frame.sleepers() + frame.num_sleepers; ++sleeper)
      *sleeper = *sleeper == index ? -1.0 : *sleeper > index ? *sleeper - 1.0 : *sleeper;
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
    if (--pieces_.front().num_frames == 0)
      pieces_.pop_front();
  }
}

} // namespace pydart2
