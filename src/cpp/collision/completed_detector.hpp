#pragma once

#include <algorithm>

#include "collision/detector.hpp"
#include "collision/missing_pairs.hpp"

namespace pydart2 {

/// One of the engine's detectors with the contacts of the pairs that it misses.
template <class Engine>
class CompletedDetector : public Engine, public ShapeChoice
{
public:
  using Engine::collide;
  bool collide(
      dart::collision::CollisionGroup* group, const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override
  {
    if (option.maxNumContacts == 0)
      return Engine::collide(group, option, result); // nothing is looked for
    const auto engine = [&](const dart::collision::CollisionOption& part) {
      return Engine::collide(group, part, result);
    };
    const bool any = engine_shapes ? engine(option) : missing_.collide(*this, *group, option, result, engine);
    return result == nullptr ? any : any && leave_out_nan(*result);
  }

  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override
  {
    missing_.forget(); // it may be where one was
    return Engine::createCollisionGroup();
  }

protected:
  explicit CompletedDetector(MissingPairs::Does does) : missing_(does) {}

  // Shapes that come, change and go. Who does not call these says forget().
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(const dart::dynamics::ShapeFrame* frame) override
  {
    missing_.forget();
    return Engine::createCollisionObject(frame);
  }
  void refreshCollisionObject(dart::collision::CollisionObject* object) override
  {
    missing_.forget();
    Engine::refreshCollisionObject(object);
  }
  void notifyCollisionObjectDestroying(dart::collision::CollisionObject* object) override
  {
    missing_.forget();
    Engine::notifyCollisionObjectDestroying(object);
  }
  void forget() { missing_.forget(); }

private:
  /// The engine leaves out contacts whose normal is zero; one of NaN, which ODE gives for a capsule in the middle of a
  /// mesh, would end the process. Whether all that was found is not left out.
  static bool leave_out_nan(dart::collision::CollisionResult& result)
  {
    const auto& now = result.getContacts();
    const auto is_whole = [](const dart::collision::Contact& contact) { return contact.normal.allFinite(); };
    if (std::all_of(now.begin(), now.end(), is_whole))
      return true;
    const auto found = now;
    result.clear();
    std::for_each(found.begin(), found.end(), [&](const auto& contact) {
      if (is_whole(contact))
        result.addContact(contact);
    });
    return result.isCollision();
  }

  MissingPairs missing_;
};

} // namespace pydart2
