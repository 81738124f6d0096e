#include "run/weave_library.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/search_path.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& library)
{
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(library, ignored)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

WeaveLookup weave_lookup(const fs::path& folder, const fs::path& library)
{
  return [folder, library](const std::string& name, std::string& error) -> std::optional<std::string> {
    const bool is_path = name.find_first_of("/.") != std::string::npos;
    const fs::path file = is_path ? folder / name : library / (name + ".json");
    std::error_code unknown;  // then reading tells
    if (!is_path && !fs::exists(file, unknown)) {
      const std::vector<std::string> names = names_in(library);
      error = names.empty() ? fmt::format("no weave '{}': there is no library in {}", name, library.string())
                            : fmt::format("no weave '{}'{}; the library has {}", name,
                                          did_you_mean(name, names), fmt::join(names, ", "));
      return std::nullopt;
    }
    try {
      return read_text_file(file.string());
    } catch (const InputError& problem) {
      error = problem.what();
      return std::nullopt;
    }
  };
}

WeaveLookup weave_lookup(const std::string& file)
{
  return weave_lookup(fs::path(file).parent_path(), shared_data_folder() / "weaves");
}

std::vector<std::string> library_weaves() { return names_in(shared_data_folder() / "weaves"); }

}  // namespace hauberk
