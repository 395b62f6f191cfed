// A plain C++ loop over World::step(): the limit of what any binding can reach.
// loop WORLD|- ROBOT|- DT GRAVITY STIFFNESS DAMPING WARM STEPS REPEATS [Q...]: prints the seconds of CPU time of one step (the
// least of REPEATS times STEPS steps from the same state), and those on the wall (of all of them).

#include <algorithm>
#include <chrono>
#include <dart/common/LocalResourceRetriever.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <dart/utils/CompositeResourceRetriever.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>
#include <ctime>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using dart::dynamics::SkeletonPtr;

SkeletonPtr load_robot(const std::string& path)
{
  const auto uri = dart::common::Uri::createFromPath(path);
  if (path.substr(path.rfind('.')) == ".urdf")
    return dart::utils::DartLoader().parseSkeleton(uri);
  auto retriever = std::make_shared<dart::utils::CompositeResourceRetriever>();
  retriever->addSchemaRetriever("file", std::make_shared<dart::common::LocalResourceRetriever>());
  return dart::utils::SdfParser::readSkeleton(uri, dart::utils::SdfParser::Options(retriever));
}

double cpu_seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int main(int argc, char** argv)
{
  const std::vector<std::string> args(argv + 1, argv + argc);
  const std::string &model = args.at(0), &robot = args.at(1);
  dart::simulation::WorldPtr world;
  if (model != "-")
    world = dart::utils::SkelParser::readWorld(dart::common::Uri::createFromPath(model));
  else
    world = dart::simulation::World::create();
  world->setTimeStep(std::stod(args.at(2)));
  world->setGravity({0.0, std::stod(args.at(3)), 0.0});
  if (robot != "-") {
    const SkeletonPtr skel = load_robot(robot);
    world->addSkeleton(skel);
    for (std::size_t i = 9; i < args.size(); ++i)
      skel->setPosition(i - 9, std::stod(args[i]));
    const double stiffness = std::stod(args.at(4));
    for (std::size_t i = 6; stiffness > 0 && i < skel->getNumDofs(); ++i) {
      auto* dof = skel->getDof(i);
      dof->setSpringStiffness(stiffness);
      dof->setRestPosition(dof->getPosition());
      dof->setDampingCoefficient(std::stod(args.at(5)));
    }
  }
  const int warm = std::stoi(args.at(6)), steps = std::stoi(args.at(7)), repeats = std::stoi(args.at(8));
  for (int i = 0; i < warm; ++i)
    world->step();
  std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> start;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i)
    start.emplace_back(world->getSkeleton(i)->getPositions(), world->getSkeleton(i)->getVelocities());
  double least = std::numeric_limits<double>::infinity();
  const auto first = std::chrono::steady_clock::now();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      world->getSkeleton(i)->setPositions(start[i].first);
      world->getSkeleton(i)->setVelocities(start[i].second);
    }
    const double begin = cpu_seconds();
    for (int i = 0; i < steps; ++i)
      world->step();
    least = std::min(least, cpu_seconds() - begin);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - first;
  std::cout << least / steps << " " << wall.count() / steps / repeats << "\n";
}
