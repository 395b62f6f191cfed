#pragma once

#include <dart/common/ResourceRetriever.hpp>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace pydart2 {

/// A model as DART's parsers get it: its text, that of the files that it includes, and where the files are that it
/// names. pydart2/loading makes it, after its checks.
class ModelSource
{
public:
  /// The kind is "skel", "sdf", "urdf", "urdf_world", "mjcf" or "vsk"; the path is absolute, and need not be there.
  ModelSource(const std::string& kind, const std::string& path);

  /// What is read for a path, in place of the file.
  void add_text(const std::string& path, const std::string& text) { texts_[path] = text; }

  /// Where URIs are that begin so.
  void add_prefix(const std::string& prefix, const std::string& replacement) { prefixes_[prefix] = replacement; }

  /// Whether a collision mesh that cannot be read is left out, with a warning.
  void set_lenient(bool lenient) { lenient_ = lenient; }

  const std::string& kind() const { return kind_; }
  const std::string& path() const { return path_; }
  bool lenient() const { return lenient_; }
  const std::map<std::string, std::string>& texts() const { return texts_; }
  const std::map<std::string, std::string>& prefixes() const { return prefixes_; }

  /// All of it, for another process.
  std::string packed() const;

private:
  std::string kind_, path_;
  std::map<std::string, std::string> texts_, prefixes_;
  bool lenient_ = false;
};

/// A source from packed().
ModelSource unpack_source(std::istream& in);

/// What DART's parsers read files with.
dart::common::ResourceRetrieverPtr make_retriever(const ModelSource& source);

} // namespace pydart2
