// Worlds for the oracle's questions: load a file, set the state given on stdin, find parts by index.

#pragma once

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <dart/common/LocalResourceRetriever.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <dart/utils/CompositeResourceRetriever.hpp>
#include <dart/utils/DartResourceRetriever.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/VskParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>

using dart::dynamics::BodyNode;
using dart::dynamics::SkeletonPtr;
using dart::simulation::WorldPtr;

inline SkeletonPtr loadSkeleton(const dart::common::Uri& uri, const std::string& kind)
{
  if (kind == ".urdf")
    return dart::utils::DartLoader().parseSkeleton(uri);
  if (kind == ".vsk")
    return dart::utils::VskParser::readSkeleton(uri);
  if (kind != ".sdf")
    throw std::invalid_argument("no loader for " + uri.toString());
  // Without a retriever of the caller's the SDF parser can crash on meshes.
  auto retriever = std::make_shared<dart::utils::CompositeResourceRetriever>();
  retriever->addSchemaRetriever("file", std::make_shared<dart::common::LocalResourceRetriever>());
  retriever->addSchemaRetriever("dart", std::make_shared<dart::utils::DartResourceRetriever>());
  return dart::utils::SdfParser::readSkeleton(uri, dart::utils::SdfParser::Options(retriever));
}

inline WorldPtr load(const std::string& file)
{
  const std::string kind = file.substr(std::min(file.rfind('.'), file.size()));
  const auto uri = dart::common::Uri::createFromPath(file);
  if (kind == ".skel") {
    if (WorldPtr world = dart::utils::SkelParser::readWorld(uri))
      return world;
  } else if (SkeletonPtr skeleton = loadSkeleton(uri, kind)) {
    WorldPtr world = dart::simulation::World::create();
    world->setGravity(Eigen::Vector3d(0.0, -9.81, 0.0));
    world->addSkeleton(skeleton);
    return world;
  }
  throw std::invalid_argument("the engine could not load " + file);
}

inline std::vector<double> readNumbers(std::istream& in)
{
  std::vector<double> numbers;
  for (std::string word; in >> word;)
    numbers.push_back(std::strtod(word.c_str(), nullptr));  // stod throws on subnormal numbers
  return numbers;
}

inline void setState(const WorldPtr& world)
{
  static const std::vector<double> numbers = readNumbers(std::cin);  // a question may prepare several worlds
  if (numbers.empty())
    return;
  std::size_t used = 0;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i) {
    const SkeletonPtr skeleton = world->getSkeleton(i);
    const std::size_t n = skeleton->getNumDofs();
    if (used + 2 * n > numbers.size())
      throw std::invalid_argument("stdin holds too few numbers for q and dq of every skeleton");
    skeleton->setPositions(Eigen::Map<const Eigen::VectorXd>(numbers.data() + used, n));
    skeleton->setVelocities(Eigen::Map<const Eigen::VectorXd>(numbers.data() + used + n, n));
    used += 2 * n;
  }
  if (used != numbers.size())
    throw std::invalid_argument("stdin holds too many numbers for q and dq of every skeleton");
}

inline WorldPtr prepare(const std::string& file)
{
  const WorldPtr world = load(file);
  setState(world);
  return world;
}

inline void stepTimes(const WorldPtr& world, const std::string& steps)
{
  for (int i = 0; i < std::stoi(steps); ++i)
    world->step();
}

inline SkeletonPtr skeletonAt(const WorldPtr& world, const std::string& index)
{
  if (std::stoul(index) >= world->getNumSkeletons())
    throw std::out_of_range("no skeleton " + index);
  return world->getSkeleton(std::stoul(index));
}

inline BodyNode* bodyAt(const SkeletonPtr& skeleton, const std::string& index)  // also: the joint above it
{
  if (std::stoul(index) >= skeleton->getNumBodyNodes())
    throw std::out_of_range("no body or joint " + index + " in " + skeleton->getName());
  return skeleton->getBodyNode(std::stoul(index));
}
