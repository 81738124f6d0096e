#include <hauberk/verify/fields.hpp>

#include <array>
#include <cctype>
#include <optional>

namespace hauberk {
namespace {

using enum VerifyPart;

// Why fields are left out. Each is a line of the report, so there are few.
constexpr std::string_view cost = "cost and course of the search";
constexpr std::string_view estimate = "estimates of the search";
constexpr std::string_view words = "words";
constexpr std::string_view origin = "what computed it";
constexpr std::string_view settings = "settings of the search, names, what the run was to meet";
constexpr std::string_view before = "the plan, made before anything was solved";
constexpr std::string_view elsewhere = "names of other files";
constexpr std::string_view motion = "curves of task transition";
constexpr std::string_view shapes = "names of shapes: what is not known here leaves primitives unchecked";
constexpr std::string_view instead = "defaults of parameters that are given";
constexpr std::string_view wider = "what results keep to, and which could allow more";
constexpr std::string_view ambiguous = "sensitivities where forces are not unique";
constexpr std::string_view stated = "states of which only the value is kept";

constexpr std::array rules{
    VerifyRule{"/format", {format}, "is the known one"},

    // The experiment, as far as results follow from it.
    VerifyRule{"/experiment/task", {format}, "is one with results"},
    VerifyRule{"/experiment/elements/*/shape", {}, shapes},
    VerifyRule{"/experiment/elements/*/parts/*/shape", {}, shapes},
    VerifyRule{"/experiment/elements/*/parts/*/position/*", {}, instead},
    VerifyRule{"/experiment/elements/**",
               {scene},
               "the scene's primitives, made anew from these by the shape's rule"},
    VerifyRule{"/experiment/cell/relax", {}, wider},
    VerifyRule{"/experiment/cell/patch/tile/*", {design}, "names of the design's variables"},
    VerifyRule{"/experiment/cell/**",
               {scene},
               "the scene's cell vectors, types, parameters and places, laid out anew"},
    VerifyRule{"/experiment/load_case/out_of_plane", {}, wider},
    VerifyRule{"/experiment/load_case/**", {asked}, "a limit for each direction and sense, as asked for"},
    VerifyRule{"/experiment/solver/clearance", {gap, contacts}, "gaps are distances less this"},
    VerifyRule{"/experiment/solver/contact", {asked}, "limits name it, or what auto chose"},
    VerifyRule{"/experiment/solver/finite_target", {asked}, "limits have it"},
    VerifyRule{"/experiment/design/quantity", {design}, "the design's"},
    VerifyRule{"/experiment/design/targets/*/direction_deg", {design}, "the design's targets"},
    VerifyRule{"/experiment/design/targets/*/value", {design}, "the design's targets"},
    VerifyRule{"/experiment/design/targets/*/weight", {design}, "the design's targets"},
    VerifyRule{"/experiment/design/targets/*/aim", {design}, "the design's targets"},
    VerifyRule{
        "/experiment/design/variables/**", {design}, "the design's variables: names, bounds, elements"},
    VerifyRule{"/experiment/sweep/**", {sweep}, "axes, measures and rows of the table"},
    VerifyRule{"/experiment/chart/scenes/*/set/**", {}, settings},
    VerifyRule{"/experiment/chart/scenes/*/reference/**", {}, settings},
    VerifyRule{"/experiment/chart/methods/*/set/**", {}, settings},
    VerifyRule{"/experiment/chart/methods/*/vary/**", {}, settings},
    VerifyRule{"/experiment/chart/**", {chart}, "scenes, methods and points of the table"},
    VerifyRule{"/experiment/stability/families/*/set/**", {}, settings},
    VerifyRule{"/experiment/stability/families/*/vary/**", {}, settings},
    VerifyRule{"/experiment/stability/methods/*/set/**", {}, settings},
    VerifyRule{"/experiment/stability/**", {stability}, "families, methods and cases of the table"},
    VerifyRule{"/experiment/**", {}, settings},

    VerifyRule{"/provenance/**", {}, origin},
    VerifyRule{"/plan/**", {}, before},
    VerifyRule{"/plan", {}, before},
    VerifyRule{"/files/**", {}, elsewhere},

    // The scene.
    VerifyRule{"/scene/cell_vectors", {scene}, "empty of a patch"},
    VerifyRule{"/scene/cell_vectors/**", {scene}, "the experiment's vectors times `repeat`"},
    VerifyRule{
        "/scene/length",
        {scene},
        "the median ring radius (of an even number the upper one), of a design that of the initial scene"},
    VerifyRule{"/scene/elements/*/type", {scene}, "as the experiment places them"},
    VerifyRule{"/scene/elements/*/parameters/*", {scene}, "the experiment's, of a design with its variables"},
    VerifyRule{"/scene/elements/*/rest/**",
               {scene, links, values},
               "as placed; where rest was relaxed or designed: unit quaternions, links as placed, no "
               "overlap; limits keep the mean of the positions"},
    VerifyRule{
        "/scene/elements/*/primitives/**",
        {scene},
        "made anew from the parameters for `torus_union`, `closed_tube` and unions of these, of solids by the "
        "plugins of their shapes; of a `mesh` R, r0, r1 against its surface"},
    VerifyRule{
        "/scene/surfaces/**",
        {scene, gap},
        "closed, at a mean distance of 1; contacts lie on them; not compared with the file they are from"},

    // Limits.
    VerifyRule{"/limits/*/load_case", {asked}, "the experiment's"},
    VerifyRule{"/limits/*/direction_deg", {asked}, "asked for by the experiment"},
    VerifyRule{"/limits/*/direction/*", {asked}, "asked for by the experiment"},
    VerifyRule{"/limits/*/sense", {asked}, "asked for by the experiment"},
    VerifyRule{"/limits/*/measure", {asked}, "the experiment's"},
    VerifyRule{"/limits/*/value", {values}, "from `macro` by the measure; on the right side of rest"},
    VerifyRule{"/limits/*/line_stretch", {values}, "from `macro`"},
    VerifyRule{"/limits/*/macro/*",
               {values},
               "gives value, companions, images, gaps, balance; also that of the start with this value"},
    VerifyRule{"/limits/*/macro", {values}, "null only without a state"},
    VerifyRule{"/limits/*/status",
               {values},
               "a known one; `locked` needs a state that passes everything here and is no saddle, profiles "
               "and tables need `locked`"},
    VerifyRule{
        "/limits/*/witness/**",
        {witness},
        "a motion: each state free of intersections, links kept, the last beyond the bound; states that end "
        "a piece which the bound leaves undecided, and the status that rests on it, are not checked"},
    VerifyRule{"/limits/*/witness", {witness}, "null only where a state is given or nothing is claimed"},
    VerifyRule{"/limits/*/message", {}, words},
    VerifyRule{"/limits/*/infimum", {values}, "null unless `not_attained`"},
    VerifyRule{"/limits/*/iterations", {}, cost},
    VerifyRule{"/limits/*/evaluations", {}, cost},
    VerifyRule{
        "/limits/*/min_gap",
        {gap},
        "smallest separation of all pairs and images, by exhaustive search; with solids enclosed between bounds"},
    VerifyRule{"/limits/*/error_estimate", {}, estimate},
    VerifyRule{"/limits/*/links_kept", {links}, "linking numbers at rest and in the state"},
    VerifyRule{"/limits/*/z_range", {values}, "from the poses"},
    VerifyRule{"/limits/*/contact", {asked}, "one that the experiment's setting allows"},
    VerifyRule{"/limits/*/quadrature_error", {}, estimate},
    VerifyRule{
        "/limits/*/finite_target", {asked, balance}, "the experiment's; part of what drives the state"},
    VerifyRule{"/limits/*/certificate", {}, words},
    VerifyRule{"/limits/*/starts/*/value", {values}, "from its `macro`; none further than `value`"},
    VerifyRule{"/limits/*/starts/*/macro/*",
               {values},
               "gives its value; that of the start with the limit's value is the limit's"},
    VerifyRule{"/limits/*/starts/**", {}, cost},
    VerifyRule{"/limits/*/starts", {}, cost},
    VerifyRule{"/limits/*/better_state", {}, cost},
    VerifyRule{"/limits/*/confidence/**", {}, cost},
    VerifyRule{"/limits/*/hold/*", {asked}, "the experiment's; what is named is zero in the state"},
    VerifyRule{"/limits/*/hold", {asked}, "the experiment's"},
    VerifyRule{"/limits/*/reactions/**",
               {held},
               "one for each that is held, as large as what forces leave of the load"},
    VerifyRule{"/limits/*/reactions", {held}, "one for each that is held"},
    VerifyRule{"/limits/*/sensitivity/clearance",
               {sensitivity},
               "minus the sum of forces, by the sense (envelope theorem), where forces are unique"},
    VerifyRule{"/limits/*/sensitivity/parameters/*",
               {sensitivity},
               "forces times differences of the gaps with the shape made anew, where forces are unique"},
    VerifyRule{"/limits/*/sensitivity/parameters", {sensitivity}, "empty only without a state"},
    VerifyRule{"/limits/*/sensitivity/**", {}, ambiguous},
    VerifyRule{"/limits/*/sensitivity_one_sided/**", {}, ambiguous},
    VerifyRule{"/limits/*/kink", {}, ambiguous},
    VerifyRule{"/limits/*/poses/**",
               {values, gap, contacts},
               "give gaps, links, contacts, balance; mean position, paraboloid or roll, and heights as the "
               "load case has them"},
    VerifyRule{"/limits/*/poses", {values}, "empty only without a state"},
    VerifyRule{"/limits/*/contacts/*/force", {balance}, "not negative; balance"},
    VerifyRule{"/limits/*/contacts/**",
               {contacts, balance},
               "points on both surfaces, normal along theirs, gap between them; balance"},
    VerifyRule{"/limits/*/contacts", {balance}, "empty only without a state"},
    VerifyRule{"/limits/*/force_balance", {balance}, "the same sum from the listed numbers"},

    VerifyRule{
        "/profiles/**", {profiles}, "directions are those of the limits; values and eta follow from them"},
    VerifyRule{"/profiles", {profiles}, "empty only without directions"},
    VerifyRule{"/boundary/margin", {}, estimate},
    VerifyRule{
        "/boundary/**", {boundary}, "triangles join limits and close; shortfalls are what the states show"},

    // Designs.
    VerifyRule{"/design", {design}, "null unless the task is a design"},
    VerifyRule{"/design/quantity", {design}, "the experiment's"},
    VerifyRule{"/design/status", {}, words},
    VerifyRule{"/design/message", {}, words},
    VerifyRule{"/design/objective_initial", {design}, "from the targets and the initial limits"},
    VerifyRule{"/design/objective", {design}, "from the targets and the final limits"},
    VerifyRule{"/design/iterations", {}, cost},
    VerifyRule{"/design/evaluations", {}, cost},
    VerifyRule{"/design/variables/**",
               {design},
               "names, bounds and elements as the experiment has them; values those of both scenes"},
    VerifyRule{"/design/targets/*/provisional", {}, cost},
    VerifyRule{"/design/targets/*/better_state", {}, cost},
    VerifyRule{
        "/design/targets/**",
        {design},
        "directions, targets, weights and aims the experiment's; values those of the limits; `met` follows"},
    VerifyRule{"/design/start", {design}, "one of `starts`"},
    VerifyRule{"/design/starts/**", {}, cost},
    VerifyRule{"/design/starts", {}, cost},
    VerifyRule{"/design/history/*/objective", {design}, "from its `values`"},
    VerifyRule{"/design/history/*/values/*", {design}, "give its objective"},
    VerifyRule{"/design/history/*/iteration", {design}, "counts through"},
    VerifyRule{"/design/history/**", {}, cost},
    VerifyRule{"/design/history", {}, cost},

    // Tables.
    VerifyRule{"/sweep/rows/*/message", {}, words},
    VerifyRule{"/sweep/**",
               {sweep},
               "axes and measures the experiment's, a row for every combination, statuses from the limits of "
               "the row, counts, what is measured from its results"},
    VerifyRule{"/chart/points/*/message", {}, words},
    VerifyRule{"/chart/points/*/iterations", {}, cost},
    VerifyRule{"/chart/points/*/evaluations", {}, cost},
    VerifyRule{"/chart/points/*/error_estimates/**", {}, estimate},
    VerifyRule{"/chart/points/*/seconds/runs/*", {}, cost},
    VerifyRule{"/chart/points/*/peak_memory_bytes", {}, cost},
    VerifyRule{"/chart/points/*/reproducible", {}, cost},
    VerifyRule{"/chart/points/*/values/*", {chart}, "the worst gives the error; the others are nearer"},
    VerifyRule{"/chart/scenes/*/reference/message", {}, words},
    VerifyRule{"/chart/scenes/*/reference/error_estimates/**", {}, estimate},
    VerifyRule{"/chart/scenes/*/reference/iterations", {}, cost},
    VerifyRule{"/chart/scenes/*/reference/evaluations", {}, cost},
    VerifyRule{"/chart/scenes/*/reference/seconds", {}, cost},
    VerifyRule{"/chart/**",
               {chart},
               "scenes, methods, settings and points as the experiment asks for; exact values, errors, "
               "medians, fronts and counts from what they follow from"},
    VerifyRule{"/stability/cases/*/message", {}, words},
    VerifyRule{"/stability/cases/*/reason", {}, words},
    VerifyRule{"/stability/cases/*/check", {}, words},
    VerifyRule{"/stability/cases/*/contact", {}, cost},
    VerifyRule{"/stability/cases/*/min_gap", {}, stated},
    VerifyRule{"/stability/cases/*/error_estimate", {}, estimate},
    VerifyRule{"/stability/cases/*/force_balance", {}, stated},
    VerifyRule{"/stability/cases/*/slack", {}, stated},
    VerifyRule{"/stability/cases/*/iterations", {}, cost},
    VerifyRule{"/stability/cases/*/evaluations", {}, cost},
    VerifyRule{"/stability/families/*/why", {stability}, "the experiment's"},
    VerifyRule{
        "/stability/**",
        {stability},
        "families, members and methods as the experiment has them; outcomes and counts from the cases"},
    VerifyRule{"/transition/**", {}, motion},
};

bool is_index(std::string_view token)
{
  if (token.empty()) return false;
  for (const char c : token)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
  return true;
}

/// The first token of a pointer, which is removed from it; nothing at its end.
std::optional<std::string_view> next_token(std::string_view& pointer)
{
  if (pointer.empty()) return std::nullopt;
  pointer.remove_prefix(1);
  const auto end = pointer.find('/');
  const std::string_view token = pointer.substr(0, end);
  pointer.remove_prefix(end == std::string_view::npos ? pointer.size() : end);
  return token;
}

bool matches(std::string_view pattern, std::string_view pointer)
{
  for (;;) {
    const auto wanted = next_token(pattern);
    if (wanted == "**") return !pointer.empty();
    const auto found = next_token(pointer);
    if (!wanted || !found) return !wanted && !found;
    if (wanted != "*" && wanted != found) return false;
  }
}

}  // namespace

std::span<const VerifyRule> verify_rules() { return rules; }

const VerifyRule* verify_rule(std::string_view pointer)
{
  for (const VerifyRule& rule : rules)
    if (matches(rule.pattern, pointer)) return &rule;
  return nullptr;
}

std::string_view without_document(std::string_view pointer)
{
  constexpr std::string_view row = "/sweep/rows/", result = "/result/", initial = "/design/initial";
  if (pointer.starts_with(row)) {
    const auto end = pointer.find('/', row.size());
    if (end != std::string_view::npos && is_index(pointer.substr(row.size(), end - row.size())) &&
        pointer.substr(end).starts_with(result))
      return pointer.substr(end + result.size() - 1);
  }
  for (const std::string_view part : {"/scene/", "/limits/"})
    if (pointer.starts_with(initial) && pointer.substr(initial.size()).starts_with(part))
      return pointer.substr(initial.size());
  return pointer;
}

std::string verify_rules_markdown()
{
  std::string out = "| field | checked | how, or why not |\n| --- | --- | --- |\n";
  for (const VerifyRule& rule : rules) {
    out += "| `" + std::string(rule.pattern) + "` | " + (rule.parts.empty() ? "no" : "yes") + " | " +
           std::string(rule.how) + " |\n";
  }
  return out;
}

}  // namespace hauberk
