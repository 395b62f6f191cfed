#include "contact/warm_lcp.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <type_traits>
#include <utility>

namespace pydart2 {

namespace {

constexpr int most_guesses = 12, longest_put_off = 63; // steps
constexpr double rounding = 1e-13; // of the largest number; in some directions A is only a hundred thousandth

} // namespace

bool WarmLcp::solve(std::size_t group, const BoxedLcp& lcp, Eigen::VectorXd& x)
{
  if (memories_.size() <= group)
    memories_.resize(group + 1);
  Memory& memory = memories_[group];
  if (memory.put_off > 0) {
    --memory.put_off;
    return false;
  }
  const bool right = guess(lcp, memory, x);
  memory.last_put_off = right ? 0 : std::min(2 * memory.last_put_off + 1, longest_put_off);
  memory.put_off = memory.last_put_off;
  return right;
}

bool WarmLcp::guess(const BoxedLcp& lcp, Memory& memory, Eigen::VectorXd& x)
{
  const auto size = static_cast<std::size_t>(lcp.b.size());
  if (memory.all.size() != size)
    memory.normal = memory.all = std::vector<Place>(size, Place::between);

  std::vector<int> all(size), normal;
  std::iota(all.begin(), all.end(), 0);
  std::copy_if(all.begin(), all.end(), std::back_inserter(normal), [&](int i) { return lcp.findex[i] < 0; });

  x.setZero(lcp.b.size());
  if (!pivot(lcp, lcp.lo, lcp.hi, normal, memory.normal, x))
    return false;
  if (normal.size() == size)
    return true;
  lo_ = lcp.lo;
  hi_ = lcp.hi;
  for (const int i : all)
    if (lcp.findex[i] >= 0) {
      hi_[i] = std::abs(lcp.hi[i] * x[lcp.findex[i]]);
      lo_[i] = -hi_[i];
    }
  return pivot(lcp, lo_, hi_, all, memory.all, x);
}

std::vector<double> WarmLcp::memory() const
{
  std::vector<double> numbers;
  for (const Memory& memory : memories_) {
    const double head[] = {double(memory.put_off), double(memory.last_put_off), double(memory.all.size())};
    numbers.insert(numbers.end(), std::begin(head), std::end(head));
    for (const auto* places : {&memory.normal, &memory.all})
      for (const Place place : *places)
        numbers.push_back(static_cast<double>(place));
  }
  return numbers;
}

bool WarmLcp::remember(const std::vector<double>& memory)
{
  std::vector<Memory> memories;
  auto next = memory.begin();
  const auto take = [&](double most, auto& value) { // a whole number from 0 to `most`
    if (next == memory.end() || !(*next >= 0.0 && *next <= most && *next == std::floor(*next)))
      return false;
    value = static_cast<std::remove_reference_t<decltype(value)>>(*next++);
    return true;
  };
  while (next != memory.end()) {
    Memory& read = memories.emplace_back();
    std::size_t size = 0;
    const auto most = static_cast<double>(memory.size());
    if (!take(longest_put_off, read.put_off) || !take(longest_put_off, read.last_put_off) || !take(most, size))
      return false;
    for (auto* places : {&read.normal, &read.all}) {
      places->resize(size);
      for (auto& place : *places)
        if (!take(double(Place::high), place))
          return false;
    }
  }
  memories_ = std::move(memories);
  return true;
}

bool WarmLcp::pivot(
    const BoxedLcp& lcp, const Eigen::VectorXd& lo, const Eigen::VectorXd& hi, const std::vector<int>& rows,
    std::vector<Place>& places, Eigen::VectorXd& x)
{
  const double force_error = rounding * lcp.b.cwiseAbs().maxCoeff();
  for (int guess = 0; guess < most_guesses; ++guess) {
    for (const int i : rows) {
      auto& place = places[static_cast<std::size_t>(i)];
      if ((place == Place::low || lo[i] == hi[i]) && std::isfinite(lo[i]))
        x[i] = lo[i], place = Place::low;
      else if (place == Place::high && std::isfinite(hi[i]))
        x[i] = hi[i];
      else
        place = Place::between;
    }
    if (!solve_between(lcp, rows, places, x))
      return false;
    const double impulse_error = rounding * x.cwiseAbs().maxCoeff();
    bool right = true;
    for (const int i : rows) {
      auto& place = places[static_cast<std::size_t>(i)];
      Place found = place;
      if (place == Place::between) {
        if (x[i] < lo[i] - impulse_error)
          found = Place::low;
        else if (x[i] > hi[i] + impulse_error)
          found = Place::high;
      } else if (lo[i] != hi[i]) {
        const double w = lcp.A.row(i).head(x.size()).dot(x) - lcp.b[i];
        if (place == Place::low ? w < -force_error : w > force_error)
          found = Place::between;
      }
      right &= found == place;
      place = found;
    }
    if (right) {
      for (const int i : rows)
        x[i] = std::min(std::max(x[i], lo[i]), hi[i]);
      return true;
    }
  }
  return false;
}

/// The rows between their bounds from those at them; false if A is not positive definite there, or not finite.
bool WarmLcp::solve_between(
    const BoxedLcp& lcp, const std::vector<int>& rows, const std::vector<Place>& places, Eigen::VectorXd& x)
{
  between_.clear();
  for (const int i : rows)
    if (places[static_cast<std::size_t>(i)] == Place::between) {
      between_.push_back(i);
      x[i] = 0.0;
    }
  const auto count = static_cast<Eigen::Index>(between_.size());
  factor_.resize(count, count);
  right_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int i = between_[static_cast<std::size_t>(k)];
    const auto row = lcp.A.row(i);
    for (Eigen::Index l = 0; l <= k; ++l)
      factor_(k, l) = row[between_[static_cast<std::size_t>(l)]];
    right_[k] = lcp.b[i] - row.head(x.size()).dot(x);
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(factor_);
  if (cholesky.info() != Eigen::Success)
    return false;
  cholesky.solveInPlace(right_);
  for (Eigen::Index k = 0; k < count; ++k)
    x[between_[static_cast<std::size_t>(k)]] = right_[k];
  return right_.allFinite();
}

} // namespace pydart2
