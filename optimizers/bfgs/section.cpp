#include "bfgs.hpp"

#include <common/fields.hpp>

namespace hauberk {

void bfgs_fields(std::vector<Field>& out)
{
  const std::vector<Field> fields = search_fields(
      "200", {count_field("memory", "20", 1e4,
                          "Latest steps whose curvature is remembered (limited-memory BFGS); 0: all.")});
  out.insert(out.end(), fields.begin(), fields.end());
}

std::unique_ptr<Optimizer> make_bfgs(const Node& section, Problems& problems)
{
  BfgsSettings settings;
  settings.memory = static_cast<std::size_t>(integer(section, "memory"));
  if (!read_search_settings(section, settings, problems)) return nullptr;
  return std::make_unique<Bfgs>(settings);
}

}  // namespace hauberk
