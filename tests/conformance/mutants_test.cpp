/// The kit finds what it is there for: each planted defect is caught by the check that is named after it, and
/// the reference passes. HAUBERK_TABLE=FILE writes which other checks a defect fails.

#include <hauberk/conformance/gtest.hpp>
#include <hauberk/conformance/isolated.hpp>

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <ostream>

namespace hauberk::conformance {
namespace {

const std::string folder = MUTANTS;

HAUBERK_CONFORMANCE_TESTS(ReferenceShape, folder + "/mutant_shape.so", R"({ "crossed": true })");
HAUBERK_CONFORMANCE_TESTS(ReferenceLoadCase, folder + "/mutant_load_case.so");
HAUBERK_CONFORMANCE_TESTS(ReferenceOptimizer, folder + "/mutant_optimizer.so");

struct Planted {
  const char* kind;
  const char* defect;
  const char* check;  ///< that catches it
  const char* text;   ///< part of what it says
};

void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.kind << ' ' << planted.defect; }

const Planted all[] = {
    {"shape", "default_outside_bounds", "shape.parameters",
     "'waist' has the default 3 outside its bounds [1, 2]"},
    {"shape", "same_name_twice", "shape.parameters", "two parameters 'R'"},
    {"shape", "no_unit", "shape.parameters", "'waist' has the unit 'furlong'"},
    {"shape", "crash", "shape.primitives", "ended by signal 11"},
    {"shape", "hang", "shape.primitives", "did not return within 2 s of processor time"},
    {"shape", "throws", "shape.primitives", "primitives failed: no primitives today"},
    {"shape", "throws_far_away", "shape.smooth", "primitives failed: not as far as that (parameters: R = "},
    {"shape", "rounds_up", "floating_point", "primitives changed the floating-point mode (rounding)"},
    {"shape", "closed_hole", "shape.refusals", "closes its radius"},
    {"shape", "unnamed_refusal", "shape.refusals", "without the name of a parameter"},
    {"shape", "unnamed_problem", "bad_values", "crossed = true is refused without naming a field"},
    {"shape", "name_changes", "shape.primitives", "depend on the parameters"},
    {"shape", "order_changes", "shape.primitives", "depend on the parameters"},
    {"shape", "number_changes", "shape.primitives", "depend on the parameters"},
    {"shape", "not_a_number", "shape.primitives", "position that is not finite"},
    {"shape", "hidden_length", "shape.scaling", "with all lengths times 2, position y of 'right'"},
    {"shape", "turns", "shape.rotations", "of axis x of 'right')/d waist"},
    {"shape", "turns_the_other_way", "shape.rotations", "of axis x of 'right')/d waist"},
    {"shape", "turns_in_degrees", "shape.rotations", "of axis x of 'right')/d waist"},
    {"shape", "kink", "shape.smooth", "jump at waist = 1.5, and it is said to be smooth"},
    {"shape", "jump", "shape.smooth", "and it is said to be smooth (parameters: R = "},
    {"shape", "meets_itself", "shape.surface", "meets itself"},
    {"shape", "shared_state", "instances", "answers otherwise once others exist"},
    {"shape", "counts_calls", "repeatable", "asked again, it answers otherwise"},
    {"shape", "not_thread_safe", "threads", "from 4 threads at once, it answers otherwise"},
    {"shape", "wrong_derivative", "shape.jacobians", "d(position x of 'right')/d waist"},
    {"shape", "nearly_right_derivative", "shape.jacobians", "d(position x of 'right')/d waist"},
    {"shape", "forgotten_column", "shape.jacobians", "d(size 2 of 'right')/d r"},
    {"shape", "transposed", "shape.jacobians", "d(position z of 'right')/d R"},
    {"shape", "too_few_rows", "shape.jacobians", "Jacobian of primitive 1 has 9 entries"},

    {"load_case", "moved_at_rest", "load_case.rest", "at rest the element"},
    {"load_case", "wrong_first_derivative", "load_case.first_derivatives", "d y/d g: the plugin says"},
    {"load_case", "nearly_right_first_derivative", "load_case.first_derivatives", "d x/d e: the plugin says"},
    {"load_case", "column_of_nobody", "load_case.first_derivatives", "column 7 of J belongs to no unknown"},
    {"load_case", "wrong_second_derivative", "load_case.second_derivatives", "d2 y/d e d e: the plugin says"},
    {"load_case", "says_it_is_flat", "load_case.second_derivatives", "(not curved, it says)"},
    {"load_case", "image_turns_with_element", "load_case.images", "for one element and"},
    {"load_case", "image_of_image_elsewhere", "load_case.images", "an image of an image is not"},
    {"load_case", "low_acceleration_bound", "load_case.acceleration", "of a path whose bound is"},
    {"load_case", "hole_in_admissible", "load_case.admissible", "not convex"},
    {"load_case", "admits_not_a_number", "load_case.admissible", "g = not-a-number is admissible"},
    {"load_case", "rest_not_admissible", "load_case.admissible", "rest is not admissible"},
    {"load_case", "narrow_stretch_range", "load_case.stretch_range", "outside the range of stretch"},
    {"load_case", "load_of_other_angle", "load_case.load", "is not d value/d g"},
    {"load_case", "load_nearly_dual", "load_case.load", "is not d value/d g"},
    {"load_case", "value_not_zero_at_rest", "load_case.load", "the value at rest is 0.1"},
    {"load_case", "no_measure", "load_case.unknowns", "its measure has no name"},
    {"load_case", "zero_metric", "load_case.unknowns", "the metric of 'g' is 0"},
    {"load_case", "rounds_down", "floating_point", "metric changed the floating-point mode (rounding)"},
    {"load_case", "wall_violated_at_rest", "load_case.walls", "'lower' is violated at rest, by 0.01"},
    {"load_case", "wall_of_nobody", "load_case.walls", "a term for element 5 of 5"},
    {"load_case", "condition_twice", "load_case.walls", "of 3 conditions only 2 are independent"},
    {"load_case", "boundedness_throws", "load_case.boundedness", "boundedness failed: no cycles"},
    {"load_case", "bounded_by_first_cycle", "load_case.boundedness",
     "a cycle that closes without a translation changes"},
    {"load_case", "bounded_by_load_size", "load_case.boundedness", "three times the load changes"},
    {"load_case", "mirrors_no_shear", "load_case.transform", "moves a lattice translation"},
    {"load_case", "turns_by_any_angle", "load_case.transform", "changes the square of the metric's norm"},
    {"load_case", "transform_not_linear", "load_case.transform", "its transformation is not linear"},
    {"load_case", "transform_stretches", "load_case.transform", "changes the square of the metric's norm"},
    {"load_case", "stricter_has_another_value", "load_case.stricter", "the value of a state of 'lower'"},
    {"load_case", "stricter_is_higher", "load_case.stricter", "beyond its walls"},
    {"load_case", "stricter_keeps_another_mean", "load_case.stricter", "off the condition 'mean x'"},
    {"load_case", "contains_nothing", "load_case.stricter", "it does not contain 'lower'"},
    {"load_case", "forgets_the_length", "load_case.scaling", "in another unit of length"},
    {"load_case", "crash", "load_case.rest", "ended by signal 11"},

    {"optimizer", "leaves_the_bounds", "optimizer.bounds", "outside its bounds"},
    {"optimizer", "ignores_constraints", "optimizer.solves.circle", "violates a constraint"},
    {"optimizer", "ignores_equalities", "optimizer.solves.hs7", "violates a constraint"},
    {"optimizer", "shares_scratch", "threads", "from 4 threads at once, it answers otherwise"},
    {"optimizer", "miscounts_batches", "optimizer.bounds", "evaluations, and made"},
    {"optimizer", "residuals_of_a_batch", "optimizer.solves.kinked",
     "residuals at another point than the one evaluated last"},
    {"optimizer", "draws_without_a_seed", "optimizer.seeds", "two runs with the same seed differ"},
    {"optimizer", "ignores_its_seed", "optimizer.seeds", "runs with four seeds are the same"},
    {"optimizer", "forgets_the_stream", "optimizer.seeds", "the same numbers for another start"},
    {"optimizer", "misled_by_hessians", "optimizer.hessians", "without a Hessian, and with one"},
    {"optimizer", "looks_again", "optimizer.evaluation_budget", "evaluations"},
    {"optimizer", "swallows_exceptions", "optimizer.exceptions", "went on to evaluate"},
    {"optimizer", "takes_failures_for_zero", "optimizer.solves.failing", "and the observer was told -1"},
    {"optimizer", "stops_early", "optimizer.solves.quadratic", "'converged' at the value"},
    {"optimizer", "climbs", "optimizer.solves.quadratic", "the least value is"},
    {"optimizer", "remembers_runs", "repeatable", "asked again, it answers otherwise"},
    {"optimizer", "ignores_the_safe_step", "optimizer.solves.short_way",
     "not on the safe part of a direction"},
    {"optimizer", "goes_a_little_too_far", "optimizer.solves.short_way",
     "not on the safe part of a direction"},
    {"optimizer", "forgets_to_accept", "optimizer.bounds", "from another point than the accepted one"},
    {"optimizer", "hang", "optimizer.bounds", "did not return within 2 s"},
    {"optimizer", "deaf", "optimizer.observer", "went on after the observer had stopped it"},
    {"optimizer", "rounds_up_meanwhile", "floating_point",
     "evaluated in another floating-point mode (rounding)"},
    {"optimizer", "wrong_value", "optimizer.bounds", "the value of the result is"},
    {"optimizer", "miscounts", "optimizer.bounds", "it counts"},
    {"optimizer", "returns_the_start", "optimizer.solves.quadratic", "the value of the result is"},
    {"optimizer", "says_converged", "optimizer.only_the_start", "it says 'converged'"},
    {"optimizer", "says_infeasible", "optimizer.solves.degenerate", "it says 'infeasible'"},
    {"optimizer", "says_nothing", "optimizer.bounds", "comes without a message"},
    {"optimizer", "unknown_status", "optimizer.bounds", "unknown status 'great'"},
    {"optimizer", "result_outside_bounds", "optimizer.bounds", "outside its bounds"},
    {"optimizer", "returns_too_few", "optimizer.bounds", "returned 4 variables, expected 5"},
    {"optimizer", "twice_the_max_evaluations", "optimizer.evaluation_budget", "with max_evaluations"},
    {"optimizer", "twice_the_max_iterations", "optimizer.iteration_budget", "with max_iterations"},
};

class Mutants : public testing::TestWithParam<Planted> {};

TEST_P(Mutants, AreCaught)
{
  const Planted& planted = GetParam();
  Conditions conditions;
  conditions.seconds = 2.0;
  conditions.setup.section = fmt::format(R"({{"defect": "{}"}})", planted.defect);
  conditions.filter = fmt::format("^{}$", planted.check);
  const bool table = std::getenv("HAUBERK_TABLE") != nullptr;
  if (table) conditions.filter.clear();
  const Report report = conform(fmt::format("{}/mutant_{}.so", folder, planted.kind), conditions);
  std::string failed;
  for (const Result& result : report.results) {
    const bool wrong =
        result.outcome.status == Outcome::Status::failed || result.outcome.status == Outcome::Status::slow;
    if (wrong) failed += " " + result.name;
    if (result.name != planted.check) continue;
    EXPECT_TRUE(wrong);
    EXPECT_NE(result.outcome.text.find(planted.text), std::string::npos) << result.outcome.text;
  }
  EXPECT_FALSE(report.results.empty());
  if (table)
    std::ofstream(std::getenv("HAUBERK_TABLE"), std::ios::app)
        << planted.kind << ' ' << planted.defect << ':' << failed << '\n';
}

TEST(Rotations, ThatTurnAsTheirRowsSayPass)
{
  Conditions conditions;
  conditions.setup.section = R"({"defect": "turns_as_it_says"})";
  conditions.filter = "^shape\\.";
  const Report report = conform(folder + "/mutant_shape.so", conditions);
  EXPECT_GT(report.results.size(), 8U);
  for (const Result& result : report.results)
    EXPECT_TRUE(result.outcome.status == Outcome::Status::passed ||
                result.outcome.status == Outcome::Status::skipped)
        << result.name << ": " << result.outcome.text;
}

INSTANTIATE_TEST_SUITE_P(Planted, Mutants, testing::ValuesIn(all), [](const auto& info) {
  return std::string(info.param.kind) + "_" + info.param.defect;
});

}  // namespace
}  // namespace hauberk::conformance
