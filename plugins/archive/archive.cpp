#include "archive/archive.hpp"

#include "archive/on_demand/zip_archive.hpp"
#include "numerics/on_demand.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <stdexcept>

namespace hauberk::archives {
namespace {

template <class Function>
Function* of_library(const char* name)
{
  if (!available()) throw ComputationError("this program was built without libzip");
  try {
    return reinterpret_cast<Function*>(on_demand("zip_archive", name));
  } catch (const std::runtime_error& e) {
    throw ComputationError(e.what());
  }
}

}  // namespace

bool available()
{
#ifdef HAUBERK_LIBZIP
  return true;
#else
  return false;
#endif
}

std::string pack(const std::vector<std::pair<std::string, std::string>>& files)
{
  std::string bytes;
  if (const char* failed = of_library<ZipPack>("hauberk_zip_pack")(files, bytes))
    throw ComputationError(fmt::format("3MF: the archive cannot be {}", failed));
  return bytes;
}

Content unpack(std::string_view bytes, const std::string& file, std::size_t most)
{
  Content content;
  content.result = of_library<ZipUnpack>("hauberk_zip_unpack")(bytes, file, most, content.text);
  return content;
}

}  // namespace hauberk::archives
