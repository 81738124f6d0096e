#include "checks.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <exception>
#include <regex>

namespace hauberk::conformance {

const char* status_name(Outcome::Status status)
{
  switch (status) {
    case Outcome::Status::passed:
      return "passed";
    case Outcome::Status::failed:
      return "failed";
    case Outcome::Status::skipped:
      return "skipped";
    case Outcome::Status::slow:
      return "slow";
  }
  return "";
}

std::vector<Check> checks(PluginKind kind)
{
  std::vector<Check> out;
  add_checks_of_every_kind(out);
  switch (kind) {
    case PluginKind::shape:
      add_shape_checks(out);
      break;
    case PluginKind::load_case:
      add_load_case_motion_checks(out);
      add_load_case_load_checks(out);
      break;
    case PluginKind::optimizer:
      add_optimizer_checks(out);
      add_declared_checks(out);
      add_known_problem_checks(out);
      break;
  }
  return out;
}

std::vector<Check> matching(const std::vector<Check>& all, const std::string& filter)
{
  std::vector<Check> out;
  try {
    const std::regex expression(filter);
    std::copy_if(all.begin(), all.end(), std::back_inserter(out),
                 [&](const Check& check) { return std::regex_search(check.name, expression); });
  } catch (const std::regex_error& error) {
    throw InputError(fmt::format("--filter: '{}' is no regular expression: {}", filter, error.what()));
  }
  if (!out.empty()) return out;
  std::string names;
  for (const Check& check : all) names += (names.empty() ? "" : ", ") + check.name;
  throw InputError(fmt::format("--filter: no check matches '{}'; there are {}", filter, names));
}

Outcome run(const Check& check, const PluginTable& table, const Setup& setup, std::uint64_t seed)
{
  using Status = Outcome::Status;
  try {
    return check.run(table, setup, seed);
  } catch (const Failure& failure) {
    return {Status::failed, failure.what()};
  } catch (const Skip& reason) {
    return {Status::skipped, reason.what()};
  } catch (const Slow& slow) {
    return {Status::slow, slow.what()};
  } catch (const std::exception& error) {
    return {Status::failed, error.what()};
  } catch (...) {
    return {Status::failed, "something was thrown that is no std::exception"};
  }
}

}  // namespace hauberk::conformance
