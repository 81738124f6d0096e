#include "sqp.hpp"

#include <common/fields.hpp>

namespace hauberk {

void sqp_fields(std::vector<Field>& out)
{
  const std::vector<Field> fields = search_fields(
      "100", {choice_field("hessian", {"gauss_newton", "bfgs"},
                           "Curvature of the model: Gauss-Newton where the problem is a sum of squares, or "
                           "damped BFGS always.")});
  out.insert(out.end(), fields.begin(), fields.end());
}

std::unique_ptr<Optimizer> make_sqp(const Node& section, Problems& problems)
{
  SqpSettings settings;
  settings.gauss_newton = section.at("hessian").string == "gauss_newton";
  if (!read_search_settings(section, settings, problems)) return nullptr;
  return std::make_unique<Sqp>(settings);
}

}  // namespace hauberk
