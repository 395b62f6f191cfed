#pragma once

#include <unordered_map>
#include <utility>

namespace pydart2 {

/// Values of objects by their addresses, to be forgotten all at once and often: as a std::unordered_map that is cleared, but
/// without giving memory back each time.
template <class Key, class Value>
class Lookup
{
public:
  void clear()
  {
    constexpr long many = 1024;
    if (++round_ % many == 0) // there are objects that come no more
      entries_.clear();
  }

  /// Null if it is not there.
  const Value* find(const Key* key) const
  {
    const auto entry = entries_.find(key);
    return entry == entries_.end() || entry->second.round != round_ ? nullptr : &entry->second.value;
  }
  Value* find(const Key* key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

  /// The value, which stays in its place, and whether `made` has just become it.
  std::pair<Value&, bool> try_emplace(const Key* key, const Value& made)
  {
    auto& entry = entries_.try_emplace(key, Entry{-1, made}).first->second;
    const bool is_new = std::exchange(entry.round, round_) != round_;
    if (is_new)
      entry.value = made;
    return {entry.value, is_new};
  }

private:
  struct Entry
  {
    long round;
    Value value;
  };

  std::unordered_map<const Key*, Entry> entries_;
  long round_ = 0;
};

} // namespace pydart2
