#include "tasks/stability/independent_check.hpp"

#include "results/document.hpp"

#include <boost/json/value.hpp>

#include <algorithm>

namespace hauberk {

namespace {

/// Asks the shapes that the run has.
VerifyShapes shapes_of(const SceneSpec& scene)
{
  return [&scene](const std::string& type, const boost::json::value& /*section*/,
                  const std::map<std::string, double>& parameters,
                  std::string& why) -> std::optional<std::vector<Primitive>> {
    const auto found = std::find_if(scene.types.begin(), scene.types.end(),
                                    [&type](const ElementType& known) { return known.name == type; });
    if (found == scene.types.end()) {
      why = "the run has no element type '" + type + "'";
      return std::nullopt;
    }
    std::vector<double> values;
    for (const ParameterInfo& info : found->shape->parameters()) values.push_back(parameters.at(info.name));
    return found->shape->primitives(values);
  };
}

}  // namespace

std::vector<VerifyLine> independent_check(const RunResult& run, const std::string& experiment_json,
                                          const std::vector<std::string>& macro_names)
{
  const boost::json::value document = results_document(run, experiment_json, macro_names);
  std::vector<VerifyLine> lines = verify(document, {}, shapes_of(run.scene)).lines;
  // A document that cannot be read at all gives a single line, which then is about every limit; the line
  // about the profiles, which comes last, is nobody's.
  const VerifyLine whole = lines.empty() ? VerifyLine{false, "the check said nothing"} : lines.back();
  lines.resize(run.limits.size(), whole);
  return lines;
}

void enter_claim(StabilityCase& into, const LimitResult& limit, const VerifyLine& check)
{
  into.status = to_string(limit.status);
  into.message = limit.message;
  into.contact = limit.contact;
  into.value = limit.value;
  into.min_gap = limit.min_gap;
  into.error_estimate = limit.error_estimate;
  into.force_balance = limit.force_balance;
  into.iterations = limit.iterations;
  into.evaluations = limit.evaluations;
  into.seconds = limit.seconds;
  into.slack = 0.0;
  for (const ContactForce& contact : limit.contacts) into.slack += contact.force * contact.gap;
  into.checked = check.ok;
  into.check = check.text;
}

}  // namespace hauberk
