#include "dynamics/weightless.hpp"

#include <vector>

namespace pydart2 {

const dart::dynamics::BodyNode* weightless_body(const dart::dynamics::Skeleton& skeleton)
{
  std::vector<bool> heavy(skeleton.getNumBodyNodes(), false);
  const dart::dynamics::BodyNode* found = nullptr;
  for (std::size_t i = skeleton.getNumBodyNodes(); i-- > 0;) { // children come after their parents
    const auto* body = skeleton.getBodyNode(i);
    heavy[i] = heavy[i] || body->getMass() > 0.0;
    if (!heavy[i] && body->getParentJoint()->getNumDofs() > 0)
      found = body;
    if (const auto* parent = body->getParentBodyNode(); parent != nullptr && heavy[i])
      heavy[parent->getIndexInSkeleton()] = true;
  }
  return found;
}

} // namespace pydart2
