#pragma once

#include <algorithm>
#include <cmath>

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
    return result == nullptr ? any : any && mend_normals(*result);
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
  /// What the engine would end the process for. It leaves out contacts whose normal is zero; one of NaN, which ODE gives for
  /// a capsule in the middle of a mesh, is left out here. FCL leaves some of two meshes at any length: they are made units;
  /// those that are units to single precision stay as they are. Whether any contact is left.
  static bool mend_normals(dart::collision::CollisionResult& result)
  {
    using dart::collision::Contact;
    const auto& now = result.getContacts();
    const auto is_sound = [](const Contact& contact) {
      return std::abs(contact.normal.squaredNorm() - 1.0) < 5e-7 || Contact::isZeroNormal(contact.normal);
    };
    if (std::all_of(now.begin(), now.end(), is_sound))
      return true;
    const auto found = now;
    result.clear();
    for (Contact contact : found) {
      if (!contact.normal.allFinite())
        continue;
      if (!is_sound(contact))
        contact.normal.stableNormalize();
      result.addContact(contact);
    }
    return result.isCollision();
  }

  MissingPairs missing_;
};

} // namespace pydart2
