// The recorded frames of a world.

#include <algorithm>
#include <limits>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "handles/world.hpp"
#include "state/contact.hpp"
#include "state/state_vector.hpp"

namespace pydart2 {

namespace {

const Frame& kept_frame(const WorldRecord& world, long index)
{
  const Frame* frame = world.recording.find(index);
  if (frame == nullptr)
    throw Error(
        Kind::index,
        "frame " + std::to_string(index) + " is not kept; the recording has frames "
            + std::to_string(world.recording.first_frame()) + " to " + std::to_string(world.recording.num_frames() - 1));
  return *frame;
}

} // namespace

bool WorldHandle::is_recording() const
{
  return world().recording.enabled();
}

void WorldHandle::set_recording(bool enable)
{
  auto& record = world();
  if (enable == record.recording.enabled())
    return;
  record.recording.set_enabled(enable);
  if (enable)
    record.record_frame();
}

long WorldHandle::num_frames() const
{
  return world().recording.num_frames();
}

long WorldHandle::first_frame() const
{
  return world().recording.first_frame();
}

bool WorldHandle::set_frame(long index)
{
  auto& record = world();
  const Frame* frame = record.recording.find(index);
  if (frame == nullptr || frame->layout != record.layout)
    return false;
  // A skeleton that was added after this frame keeps its state.
  std::vector<double> states(static_cast<std::size_t>(num_states(record)));
  write_states(record, states.data());
  std::copy(frame->state, frame->contacts(), states.begin());
  read_states(record, states.data());
  return true;
}

void WorldHandle::frame_states(long index, Output& out) const
{
  const auto& frame = kept_frame(world(), index);
  std::copy(frame.state, frame.contacts(), out.vector(static_cast<long>(frame.num_states)));
}

void WorldHandle::recorded_times(Output& out) const
{
  const auto& recording = world().recording;
  const long first = recording.first_frame();
  auto times = vector(out, recording.num_frames() - first);
  for (long i = 0; i < times.size(); ++i)
    times[i] = recording.find(first + i)->time;
}

void WorldHandle::recorded_states(Output& out) const
{
  const auto& record = world();
  const long first = record.recording.first_frame();
  auto states = matrix(out, record.recording.num_frames() - first, num_states(record));
  states.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (long i = 0; i < states.rows(); ++i) {
    const Frame& frame = *record.recording.find(first + i);
    if (frame.layout == record.layout)
      std::copy(frame.state, frame.contacts(), states.row(i).data());
  }
}

void WorldHandle::frame_sleepers(long index, Output& out) const
{
  const auto& frame = kept_frame(world(), index);
  std::copy(frame.sleepers(), frame.sleepers() + frame.num_sleepers, out.vector(static_cast<long>(frame.num_sleepers)));
}

void WorldHandle::frame_contacts(long index, Output& out) const
{
  const auto& frame = kept_frame(world(), index);
  double* rows = out.matrix(static_cast<long>(frame.num_contacts), contact_columns);
  std::copy(frame.contacts(), frame.contacts() + frame.num_contacts * contact_columns, rows);
}

void WorldHandle::clear_recording()
{
  auto& record = world();
  record.recording.clear();
  record.record_frame();
}

void WorldHandle::record_frame()
{
  world().record_frame();
}

long WorldHandle::recording_bytes() const
{
  return static_cast<long>(world().recording.bytes());
}

long WorldHandle::recording_limit() const
{
  return static_cast<long>(world().recording.limit());
}

void WorldHandle::set_recording_limit(long bytes)
{
  if (bytes < 0)
    throw Error(Kind::value, "the recording limit must be zero or more bytes, got " + std::to_string(bytes));
  world().recording.set_limit(static_cast<std::size_t>(bytes));
}

} // namespace pydart2
