#include "engine/late_sizes.hpp"

#include "engine/import_table.hpp"

namespace pydart2 {

namespace {

struct Members : dart::dynamics::Skeleton
{
  using Cache = DataCache;
  static constexpr auto whole = &Members::mSkelCache;
  static constexpr auto trees = &Members::mTreeCache;
};

thread_local int alive = 0;

/// What Skeleton::updateCacheDimensions(DataCache&) does.
void size(Members::Cache& cache)
{
  const auto n = static_cast<Eigen::Index>(cache.mDofs.size());
  for (auto* matrix : {&cache.mM, &cache.mAugM, &cache.mInvM, &cache.mInvAugM})
    *matrix = Eigen::MatrixXd::Zero(n, n);
  for (auto* vector : {&cache.mCvec, &cache.mG, &cache.mCg, &cache.mFext, &cache.mFc})
    *vector = Eigen::VectorXd::Zero(n);
}

void update(void*, Members::Cache& cache)
{
  if (alive == 0)
    size(cache);
}

} // namespace

LateSizes::LateSizes()
{
  static const int libraries = redirect(
      {"libdart"}, "_ZN4dart8dynamics8Skeleton21updateCacheDimensionsERNS1_9DataCacheE", reinterpret_cast<void*>(&update));
  alive += libraries > 0;
}

LateSizes::~LateSizes()
{
  alive -= alive > 0;
}

void LateSizes::give(dart::dynamics::Skeleton& skeleton)
{
  size(skeleton.*Members::whole);
  for (auto& tree : skeleton.*Members::trees)
    size(tree);
}

} // namespace pydart2
