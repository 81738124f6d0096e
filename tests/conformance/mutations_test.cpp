/// Mistakes as authors make them, each planted in a plugin that is right otherwise: what a check of the whole
/// kit, run as `hauberk plugins conform` runs it, says of them. The last line of each kind tells how many
/// were caught; misses that are known are listed with their reason, and a miss that is caught after all
/// fails, too.

#include <hauberk/conformance/isolated.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace hauberk::conformance {
namespace {

struct Mistake {
  const char* defect;
  const char* missed_because = nullptr;  ///< null: it must be caught
};

/// Mistakes of calls of any kind.
const std::vector<Mistake> of_any_kind = {
    {"heap_overwrite"},
    {"heap_overwrite_in_slack",
     "the C library gives 8 bytes more than it was asked for; a build with -fsanitize=address sees it"},
    {"use_after_free"},
    {"not_initialised"},
    {"rand"},
    {"process_id"},
    {"address"},
    {"code_address"},
    {"clock"},
    {"next_year", "its answers are right until 2100"},
    {"remembers_the_last"},
    {"tires"},
    {"directory"},
    {"locale"},
    {"cpp_locale"},
    {"precision"},
    {"hexadecimal"},
    {"deaf_stream"},
    {"prints"},
    {"prints_errors"},
    {"environment"},
    {"signals"},
    {"file_mask"},
    {"descriptors"},
    {"exits"},
    {"throws_int"},
    {"sleeps"},
    {"slow"},
    {"traps"},
    {"crash"},
    {"hang"},
};

const std::vector<Mistake> of_shapes = {
    {"unit_of_r"},
    {"unit_of_waist"},
    {"default_outside_bounds"},
    {"same_name_twice"},
    {"number_changes"},
    {"order_changes"},
    {"unnamed_refusal"},
    {"kink"},
    {"bounds_the_wrong_way"},
    {"parameter_without_name"},
    {"turns"},
    {"turns_far"},
    {"turns_behind_option"},
    {"turns_the_other_way"},
    {"turns_in_degrees"},
    {"jump"},
    {"jump_far"},
    {"jump_of_r_far"},
    {"kink_far"},
    {"needle",
     "a jump at one place in 5e5, on an interval of 2e-5: no search of finite length meets all of these"},
    {"throws_in_corner"},
    {"jacobian_throws_in_corner"},
    {"not_a_number_in_corner"},
    {"refuses_without_name_far"},
    {"single_precision"},
    {"forgets_r"},
    {"forgets_R"},
    {"hidden_length"},
    {"length_behind_option"},
    {"length_in_jacobian"},
    {"unknown_kind_behind_option"},
    {"two_radii"},
    {"throws_behind_option"},
    {"mirrored"},
    {"name_behind_bound"},
    {"factor", "another shape whose derivatives are right: only its author knows which one was meant"},
    {"wrong_derivative"},
    {"sign_behind_option"},
    {"nearly_right_derivative"},
    {"nearly_right_behind_option"},
    {"sign_far"},
    {"off_by_1e-9_R"},
    {"of_the_other_ring"},
    {"transposed"},
    {"forgotten_column"},
    {"too_few_rows_behind_option"},
    {"jacobian_rounds_down"},
    {"make_moves"},
    {"make_throws_behind_option"},
    {"make_returns_nothing_behind_option"},
    {"shared_state"},
    {"not_thread_safe"},
    {"meets_itself"},
    {"closed_hole"},
};

const std::vector<Mistake> of_solids = {
    {"radius_times_0.9"},
    {"offset"},
    {"fold"},
    {"probe_derivative_sign"},
    {"probe_second_derivative"},
    {"probe_bounds_times_0.9"},
    {"probe_bounds_times_0.5"},
    {"probe_bounds_of_the_middle"},
    {"probe_bounds_of_the_ends"},
    {"mixed_bound_times_0.9"},
    {"third_bounds_times_0.5"},
    {"first_derivative_jumps"},
    {"chart_of_another_torus"},
    {"convex_times_0.9"},
    {"convex_times_0.5"},
    {"convex_of_the_outer_side"},
    {"reach_times_1.1"},
    {"reach_times_2"},
    {"said_to_be_convex"},
    {"change_of_a_sphere"},
    {"jump_of_curvature_not_told"},
    {"jump_of_a_thin_strut_not_told"},
    {"distance_by_r_sign"},
    {"distance_by_R_nearly_right"},
    {"probe_by_r_forgets_z"},
    {"sizes_by_parameters"},
    {"field_without_the_tube"},
    {"field_is_no_distance"},
    {"inside_positive"},
    {"certain_of_too_much"},
    {"normal_inwards"},
    {"normal_not_unit"},
    {"curvatures_swapped"},
    {"curvature_of_the_surface"},
    {"shifted_field"},
};

const std::vector<Mistake> of_load_cases = {
    {"value_length_power"},
    {"macro_length_power"},
    {"forgets_the_length"},
    {"value_in_percent"},
    {"same_unknown_twice"},
    {"load_has_the_wrong_sign"},
    {"load_behind_option"},
    {"load_nearly_dual"},
    {"wrong_first_derivative"},
    {"nearly_right_first_derivative"},
    {"sign_behind_option"},
    {"nearly_right_behind_option"},
    {"wrong_second_derivative"},
    {"second_derivative_far"},
    {"says_it_is_flat"},
    {"low_acceleration_bound"},
    {"half_acceleration_bound"},
    {"bound_of_the_start"},
    {"bound_of_the_mean"},
    {"acceleration_bound_of_the_element"},
    {"narrow_stretch_range"},
    {"stretch_range_times_0.9"},
    {"stretch_range_times_0.999"},
    {"stretch_range_from_above"},
    {"stretch_range_of_the_axes"},
    {"throws_far"},
    {"not_a_number_far"},
    {"single_precision"},
    {"static_scratch"},
    {"image_drifts"},
    {"metric_behind_option"},
    {"hole_in_admissible"},
    {"mirrors_no_shear"},
    {"stricter_is_higher"},
    {"value_directory"},
    {"value_locale"},
    {"value_prints"},
    {"make_prints"},
};

const std::vector<Mistake> of_optimizers = {
    {"leaves_the_bounds"},
    {"ignores_constraints"},
    {"looks_again"},
    {"swallows_exceptions"},
    {"takes_failures_for_zero"},
    {"stops_early"},
    {"climbs"},
    {"remembers_runs"},
    {"ignores_the_safe_step"},
    {"goes_a_little_too_far"},
    {"forgets_to_accept"},
    {"deaf"},
    {"rounds_up_meanwhile"},
    {"miscounts"},
    {"says_converged"},
    {"result_outside_bounds"},
    {"twice_the_max_evaluations"},
    {"ignores_equalities"},
    {"shares_scratch"},
    {"miscounts_batches"},
    {"residuals_of_a_batch"},
    {"draws_without_a_seed"},
    {"ignores_its_seed"},
    {"forgets_the_stream"},
    {"misled_by_hessians"},
};

/// The default run of the kit, which ends at the first check that does not pass.
Report conformed(const std::string& kind, const std::string& defect, int seeds)
{
  Conditions conditions;
  conditions.seconds = defect == "hang" ? 1.0 : 20.0;
  conditions.until_failure = true;
  conditions.seeds = seeds;
  conditions.setup.section = fmt::format(R"({{"defect": "{}"}})", defect);
  return conform(fmt::format("{}/mutant_{}.so", MUTANTS, kind), conditions);
}

std::string first_words(const Report& report)
{
  for (const Result& r : report.results) {
    if (r.outcome.status == Outcome::Status::failed || r.outcome.status == Outcome::Status::slow)
      return fmt::format("{}: {}", r.name, r.outcome.text);
  }
  return "";
}

class Mutations : public testing::TestWithParam<const char*> {};

const std::vector<Mistake>& own_mistakes(const std::string& kind)
{
  if (kind == "shape") return of_shapes;
  if (kind == "solid") return of_solids;
  return kind == "load_case" ? of_load_cases : of_optimizers;
}

TEST_P(Mutations, AreCaught)
{
  const std::string kind = GetParam();
  std::vector<Mistake> all = own_mistakes(kind);
  if (kind != "solid") all.insert(all.end(), of_any_kind.begin(), of_any_kind.end());
  int caught = 0;
  std::string misses;
  for (const Mistake& mistake : all) {
    const Report report = conformed(kind, mistake.defect, 1);
    EXPECT_EQ(report.passed(), mistake.missed_because != nullptr) << mistake.defect << ": " << report.text();
    if (report.passed()) {
      misses += fmt::format("  missed: {} ({})\n", mistake.defect,
                            mistake.missed_because == nullptr ? "unexpectedly" : mistake.missed_because);
    } else {
      ++caught;
      std::printf("  %-34s %.110s\n", mistake.defect, first_words(report).c_str());
    }
  }
  std::printf("%s: %d of %zu mistakes caught\n%s", kind.c_str(), caught, all.size(), misses.c_str());
  EXPECT_GE(caught, 0.95 * static_cast<double>(all.size()));
}

/// No false alarm.
TEST_P(Mutations, TheRightOnePasses)
{
  const Report report = conformed(GetParam(), "none", 5);
  EXPECT_TRUE(report.passed()) << report.text();
}

INSTANTIATE_TEST_SUITE_P(Of, Mutations, testing::Values("shape", "solid", "load_case", "optimizer"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace hauberk::conformance
