#include "loading.hpp"

#include <algorithm>
#include <cctype>
#include <dart/common/LocalResourceRetriever.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/VskParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>
#include <filesystem>

#include "errors.hpp"

namespace pydart2 {

namespace {

namespace fs = std::filesystem;

/// The URI of a file that is there; DART's parsers need absolute ones.
dart::common::Uri uri_of(const std::string& path)
{
  if (!fs::exists(path))
    throw Error(Kind::load, "no file '" + path + "'");
  if (fs::is_directory(path))
    throw Error(Kind::load, "'" + path + "' is a folder, not a model file");
  return dart::common::Uri::createFromPath(fs::absolute(path).string());
}

std::string extension_of(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Runs one of DART's parsers; whatever it throws and its null both become a LoadError.
template <class Parse>
auto parse(const std::string& path, Parse&& parser)
{
  decltype(parser()) result;
  try {
    result = parser();
  } catch (const std::exception& error) {
    throw Error(Kind::load, "cannot load '" + path + "': " + error.what());
  }
  if (!result)
    throw Error(Kind::load, "cannot load '" + path + "': the parser found no valid model in it");
  return result;
}

} // namespace

dart::simulation::WorldPtr load_world(const std::string& path)
{
  const auto uri = uri_of(path);
  return parse(path, [&] { return dart::utils::SkelParser::readWorld(uri); });
}

dart::simulation::WorldPtr load_world_text(const std::string& xml)
{
  return parse("XML text", [&] { return dart::utils::SkelParser::readWorldXML(xml); });
}

dart::dynamics::SkeletonPtr load_skeleton(const std::string& path)
{
  const std::string extension = extension_of(path);
  using namespace dart::utils;
  // An explicit retriever: without one the SDF parser crashes on meshes.
  const auto retriever = std::make_shared<dart::common::LocalResourceRetriever>();
  if (extension == ".sdf")
    return parse(path, [&, uri = uri_of(path)] { return SdfParser::readSkeleton(uri, SdfParser::Options(retriever)); });
  if (extension == ".urdf")
    return parse(path, [&, uri = uri_of(path)] { return DartLoader().parseSkeleton(uri); });
  if (extension == ".vsk")
    return parse(path, [&, uri = uri_of(path)] { return VskParser::readSkeleton(uri); });
  if (extension == ".skel")
    return parse(path, [&, uri = uri_of(path)] { return SkelParser::readSkeleton(uri); });
  throw Error(
      Kind::load, "cannot load '" + path + "': unknown extension '" + extension + "'; known are .urdf .sdf .skel .vsk");
}

} // namespace pydart2
