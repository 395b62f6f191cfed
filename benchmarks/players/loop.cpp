#include "loop.hpp"

#include <dart/common/LocalResourceRetriever.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/utils/CompositeResourceRetriever.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>
#include <ctime>
#include <memory>
#include <string>

using dart::dynamics::SkeletonPtr;

static SkeletonPtr load_robot(const std::string& path)
{
  const auto uri = dart::common::Uri::createFromPath(path);
  if (path.substr(path.rfind('.')) == ".urdf")
    return dart::utils::DartLoader().parseSkeleton(uri);
  auto retriever = std::make_shared<dart::utils::CompositeResourceRetriever>();
  retriever->addSchemaRetriever("file", std::make_shared<dart::common::LocalResourceRetriever>());
  return dart::utils::SdfParser::readSkeleton(uri, dart::utils::SdfParser::Options(retriever));
}

static double cpu_seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Loop* loop_make(int count, const char* const* arguments)
{
  const std::vector<std::string> args(arguments, arguments + count);
  const std::string &model = args.at(0), &robot = args.at(1);
  auto loop = std::make_unique<Loop>();
  auto& world = loop->world;
  if (model != "-")
    world = dart::utils::SkelParser::readWorld(dart::common::Uri::createFromPath(model));
  else
    world = dart::simulation::World::create();
  world->setTimeStep(std::stod(args.at(2)));
  world->setGravity({0.0, std::stod(args.at(3)), 0.0});
  if (robot != "-") {
    const SkeletonPtr skel = load_robot(robot);
    world->addSkeleton(skel);
    for (std::size_t i = 7; i < args.size(); ++i)
      skel->setPosition(i - 7, std::stod(args[i]));
    const double stiffness = std::stod(args.at(4));
    for (std::size_t i = 6; stiffness > 0 && i < skel->getNumDofs(); ++i) {
      auto* dof = skel->getDof(i);
      dof->setSpringStiffness(stiffness);
      dof->setRestPosition(dof->getPosition());
      dof->setDampingCoefficient(std::stod(args.at(5)));
    }
  }
  for (int i = 0; i < std::stoi(args.at(6)); ++i)
    world->step();
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i)
    loop->start.emplace_back(world->getSkeleton(i)->getPositions(), world->getSkeleton(i)->getVelocities());
  return loop.release();
}

void loop_restart(Loop* loop)
{
  for (std::size_t i = 0; i < loop->start.size(); ++i) {
    loop->world->getSkeleton(i)->setPositions(loop->start[i].first);
    loop->world->getSkeleton(i)->setVelocities(loop->start[i].second);
  }
}

double loop_steps(Loop* loop, int count)
{
  const double begin = cpu_seconds();
  for (int i = 0; i < count; ++i)
    loop->world->step();
  return cpu_seconds() - begin;
}

double loop_position(Loop* loop)
{
  return loop->world->getSkeleton(loop->world->getNumSkeletons() - 1)->getPosition(0);
}
