#pragma once

#include <string>
#include <vector>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// What world.set_blow_up("nan") makes NaN of; other errors of a step are the user's to mend.
class BlowUp : public Error
{
public:
  explicit BlowUp(const std::string& message) : Error(Kind::simulation, message) {}
};

/// Also false for NaN.
inline bool sane(double value)
{
  return std::abs(value) <= check::huge;
}

inline bool sane(const Eigen::Vector3d& value)
{
  return sane(value[0]) && sane(value[1]) && sane(value[2]);
}

/// As a message shows a number.
std::string text(double value);

/// Says which number of a skeleton became what.
[[noreturn]] void blown_up(
    const dart::dynamics::Skeleton& skeleton, const std::string& where, const char* what, double value, double time);

/// Says that the engine gave up in a step, with the place to look at, as it does not say which it is.
[[noreturn]] void engine_failed(const WorldRecord& record, const std::string& error, const std::string& suspect);

/// The place to look at where the engine does not say which it is.
std::string suspect(const WorldRecord& record);

/// The skeletons whose state is not one any more; where all are, the one that suspect() names.
std::vector<SkeletonRef> insane_or_suspect(const WorldRecord& record);

} // namespace pydart2
