#include "loading/model_source.hpp"

#include <algorithm>
#include <cstring>
#include <dart/common/LocalResource.hpp>
#include <dart/common/Uri.hpp>
#include <filesystem>
#include <istream>
#include <sstream>

#include "engine/shared_scenes.hpp"

namespace pydart2 {

namespace {

/// A text in memory that is read like a file.
class TextResource : public dart::common::Resource
{
public:
  explicit TextResource(const std::string& text) : text_(text) {}

  std::size_t getSize() override { return text_.size(); }
  std::size_t tell() override { return at_; }

  bool seek(std::ptrdiff_t offset, SeekType origin) override
  {
    const std::size_t from = origin == SEEKTYPE_SET ? 0 : origin == SEEKTYPE_CUR ? at_ : text_.size();
    const auto target = static_cast<std::ptrdiff_t>(from) + offset;
    if (target < 0 || target > static_cast<std::ptrdiff_t>(text_.size()))
      return false;
    at_ = static_cast<std::size_t>(target);
    return true;
  }

  std::size_t read(void* buffer, std::size_t size, std::size_t count) override
  {
    if (size == 0)
      return 0;
    const std::size_t read = std::min(count, (text_.size() - at_) / size);
    std::memcpy(buffer, text_.data() + at_, read * size);
    at_ += read * size;
    return read;
  }

private:
  const std::string text_;
  std::size_t at_ = 0;
};

class Retriever : public dart::common::ResourceRetriever
{
public:
  explicit Retriever(const ModelSource& source) : texts_(source.texts()), prefixes_(source.prefixes()) {}

  bool exists(const dart::common::Uri& uri) override { return !getFilePath(uri).empty(); }

  dart::common::ResourcePtr retrieve(const dart::common::Uri& uri) override
  {
    const std::string path = getFilePath(uri);
    if (path.empty())
      return nullptr;
    const auto text = texts_.find(path);
    if (text != texts_.end())
      return std::make_shared<TextResource>(text->second);
    return std::make_shared<dart::common::LocalResource>(path);
  }

  /// Empty if there is no such file.
  std::string getFilePath(const dart::common::Uri& uri) override
  {
    const std::string path = path_of(uri);
    std::error_code error;
    return texts_.count(path) != 0 || std::filesystem::is_regular_file(path, error) ? path : std::string();
  }

private:
  std::string path_of(const dart::common::Uri& uri) const
  {
    const std::string whole = uri.toString();
    // The last that is not greater is the longest prefix, or one that has it as a prefix.
    for (auto it = prefixes_.upper_bound(whole); it != prefixes_.begin();) {
      --it;
      if (whole.compare(0, it->first.size(), it->first) == 0)
        return it->second + whole.substr(it->first.size());
    }
    if (const auto scheme = mirror_scheme(whole); !scheme.empty())
      return whole.substr(scheme.size() + 3);
    const std::string file = "file://"; // a path may have '?' and '#', which DART takes for parts of a URI
    if (whole.compare(0, file.size(), file) == 0)
      return whole.substr(file.size());
    return uri.mScheme ? std::string() : whole;
  }

  const std::map<std::string, std::string> texts_, prefixes_;
};

void pack(std::ostream& out, const std::string& text)
{
  out << text.size() << ' ' << text;
}

std::string unpack_text(std::istream& in)
{
  std::size_t size = 0;
  in >> size;
  in.get();
  std::string text(in ? size : 0, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

void pack(std::ostream& out, const std::map<std::string, std::string>& table)
{
  out << table.size() << ' ';
  for (const auto& [key, value] : table) {
    pack(out, key);
    pack(out, value);
  }
}

std::map<std::string, std::string> unpack_table(std::istream& in)
{
  std::size_t size = 0;
  in >> size;
  std::map<std::string, std::string> table;
  for (std::size_t i = 0; i < size && in; ++i) {
    std::string key = unpack_text(in);
    table[std::move(key)] = unpack_text(in);
  }
  return table;
}

} // namespace

ModelSource::ModelSource(const std::string& kind, const std::string& path) : kind_(kind), path_(path) {}

std::string ModelSource::packed() const
{
  std::ostringstream out;
  pack(out, kind_);
  pack(out, path_);
  pack(out, texts_);
  pack(out, prefixes_);
  out << lenient_ << ' ';
  return out.str();
}

ModelSource unpack_source(std::istream& in)
{
  const std::string kind = unpack_text(in);
  ModelSource source(kind, unpack_text(in));
  for (const auto& [path, text] : unpack_table(in))
    source.add_text(path, text);
  for (const auto& [prefix, replacement] : unpack_table(in))
    source.add_prefix(prefix, replacement);
  bool lenient = false;
  in >> lenient;
  source.set_lenient(lenient);
  return source;
}

dart::common::ResourceRetrieverPtr make_retriever(const ModelSource& source)
{
  return std::make_shared<Retriever>(source);
}

} // namespace pydart2
