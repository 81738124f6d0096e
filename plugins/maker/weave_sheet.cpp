#include "maker/weave_sheet.hpp"

#include "document/json_text.hpp"
#include "equilibrium/gaps.hpp"
#include "maker/job_limits.hpp"
#include "maker/lattice_step.hpp"
#include "maker/sheet_shape.hpp"
#include "maker/weave_roll.hpp"
#include "run/confidence_marks.hpp"
#include "run/interrupt.hpp"
#include "tasks/job.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>

#include <cmath>
#include <numbers>

namespace hauberk::maker {
namespace {

constexpr double far = 4.0;                            // of gaps that are looked for, in ring radii
constexpr double square_decimetre = 1e4, metre = 1e3;  // mm^2, mm

/// How far a lattice repeats itself along a direction; 0 where it does not.
double pitch_along(const std::vector<Vec3>& lattice, double degrees)
{
  const std::optional<LatticeStep> step = step_along(lattice, degrees);
  return step ? step->length : 0.0;
}

Job job_of(const Weave& weave, const Question& question, double clearance, const WeaveLookup& lookup,
           const std::shared_ptr<const Registry>& registry)
{
  return prepare_job(
      registry, {"hauberk weave " + question.weave, experiment_text(weave, question, clearance), {}, lookup});
}

/// 2 pi^2 R r0 r1 of the ring that the element is.
double wire_volume(const SceneSpec& scene, const PlacedElement& element)
{
  const std::vector<Primitive> rings = scene.types[element.type].shape->primitives(element.parameters);
  const PrimitiveKind kind = rings.front().kind;
  if (rings.size() != 1 || (kind != PrimitiveKind::circle_tube && kind != PrimitiveKind::revolved_ellipse))
    throw InputError(
        fmt::format("'{}' is no single ring of round or oval wire, as a maker's answers need it; use "
                    "`hauberk run` for its limits",
                    scene.types[element.type].name));
  const auto& [R, r0, r1] = rings.front().size;
  return 2.0 * std::numbers::pi * std::numbers::pi * R * r0 * r1;
}

/// Surfaces that stay a gap apart are those of wire as much thicker that touch.
Question thicker(const Question& question)
{
  Question out = question;
  out.inner -= question.gap;
  out.wire += question.gap;
  if (out.small) {
    out.small->inner -= question.gap;
    out.small->wire += question.gap;
  }
  return out;
}

/// What limits of all ways, both senses, say.
std::vector<WayAnswer> answers(const Job& job, const Weave& weave, const std::vector<LimitResult>& limits)
{
  const Prepared& prepared = *job.prepared;
  const std::vector<LimitTask> tasks = job.task->limit_tasks();
  std::vector<WayAnswer> out;
  for (const Weave::Way& way : weave.ways) {
    WayAnswer& answer = out.emplace_back();
    answer.name = way.name;
    answer.degrees = way.degrees;
    answer.pitch = pitch_along(prepared.scene.lattice, way.degrees);
  }
  for (std::size_t k = 0; k < limits.size(); ++k) {
    WayAnswer& way = out[k / 2];
    const bool stretches = tasks[k].sense == Sense::positive;
    const bool locked = limits[k].status == LimitStatus::locked;
    (stretches ? way.stretch : way.compress) = locked ? limits[k].value : std::nullopt;
    (stretches ? way.stretch_status : way.compress_status) = to_string(limits[k].status);
    (stretches ? way.stretch_confidence : way.compress_confidence) = limits[k].confidence.word;
    if (!locked || weave.ways.size() == 1) continue;
    (stretches ? way.stretch_across : way.compress_across) = strain_across(limits[k], way.degrees);
    (stretches ? way.stretch_thickness : way.compress_thickness) = thickness(prepared.scene, limits[k].poses);
  }
  return out;
}

/// Lines of a table of ways.
std::string ways_text(const std::vector<WayAnswer>& ways)
{
  std::string text = fmt::format("  {:<24}{:>12}{:>22}{:>22}{:>18}\n", "", "at rest", "taut",
                                 "pushed together", "packed to taut");
  for (const WayAnswer& way : ways) {
    const auto pitch = [&](const std::optional<double>& strain, const std::string& status,
                           const std::string& confidence) {
      const std::string told = strain_text(strain, status, confidence);
      return strain && way.pitch > 0.0 ? fmt::format("{:.3f} mm ({})", way.pitch * (1.0 + *strain), told)
                                       : told;
    };
    const std::string whole =
        way.stretch && way.compress
            ? fmt::format("{:+.1f} %", 100.0 * ((1.0 + *way.stretch) / (1.0 + *way.compress) - 1.0))
            : "";
    text += fmt::format("  {:<24}{:>12}{:>22}{:>22}{:>18}\n", way.name,
                        way.pitch > 0.0 ? fmt::format("{:.3f} mm", way.pitch) : "",
                        pitch(way.stretch, way.stretch_status, way.stretch_confidence),
                        pitch(way.compress, way.compress_status, way.compress_confidence), whole);
  }
  return text;
}

/// How wide and thick the sheet is in the states of its ways; nothing of a chain.
std::string shapes_text(const Sheet& sheet)
{
  if (sheet.chain) return "";
  std::string text = fmt::format("  {:<40}{:>12}{:>12}\n  {:<40}{:>12}{:>9.2f} mm\n", "", "sideways", "thick",
                                 "the sheet at rest", "", sheet.thickness);
  for (const WayAnswer& way : sheet.ways) {
    const auto line = [&](const char* what, const std::optional<double>& across,
                          const std::optional<double>& thick) {
      if (!across || !thick) return;
      text += fmt::format("  {:<40}{:>12}{:>9.2f} mm\n", fmt::format("{} {}", what, way.name),
                          fmt::format("{:+.1f} %", 100.0 * *across), *thick);
    };
    line("taut", way.stretch_across, way.stretch_thickness);
    line("pushed together", way.compress_across, way.compress_thickness);
  }
  return text + "\n";
}

boost::json::array ways_json(const std::vector<WayAnswer>& ways)
{
  boost::json::array out;
  for (const WayAnswer& way : ways) {
    boost::json::object entry{{"name", way.name}, {"direction_deg", way.degrees}};
    entry["pitch_mm"] = way.pitch > 0.0 ? boost::json::value(way.pitch) : nullptr;
    entry["stretch"] = way.stretch ? boost::json::value(*way.stretch) : nullptr;
    entry["stretch_status"] = way.stretch_status;
    entry["stretch_confidence"] = way.stretch_confidence;
    entry["compress"] = way.compress ? boost::json::value(*way.compress) : nullptr;
    entry["compress_status"] = way.compress_status;
    entry["compress_confidence"] = way.compress_confidence;
    for (const auto& [key, value] : {std::pair{"stretch_across", way.stretch_across},
                                     {"compress_across", way.compress_across},
                                     {"stretch_thickness_mm", way.stretch_thickness},
                                     {"compress_thickness_mm", way.compress_thickness}})
      if (value) entry[key] = *value;
    out.push_back(std::move(entry));
  }
  return out;
}

/// The widest gap that the rings leave between each other, by halves.
double largest_gap(const RingFit& fit, Question question)
{
  double low = 0.0, high = question.gap;
  for (int k = 0; k < 40; ++k) {
    question.gap = 0.5 * (low + high);
    (fit.fits(thicker(question)) ? low : high) = question.gap;
  }
  return low;
}

/// Lowest and highest mm by diameter; null: none, and no end.
boost::json::object fitting_json(const Fitting& fitting)
{
  const auto ends = [](const std::optional<Range>& range) -> boost::json::value {
    if (!range) return nullptr;
    return {range->low,
            std::isinf(range->high) ? boost::json::value(nullptr) : boost::json::value(range->high)};
  };
  boost::json::object out{{"inner_mm", ends(fitting.inner)}, {"wire_mm", ends(fitting.wire)}};
  if (fitting.two_sizes) out["small_inner_mm"] = ends(fitting.small_inner);
  if (fitting.small_wire) out["small_wire_mm"] = ends(fitting.small_wire);
  return out;
}

}  // namespace

std::string strain_text(const std::optional<double>& value, const std::string& status,
                        const std::string& confidence)
{
  return value ? fmt::format("{:+.1f} %{}", 100.0 * *value, confidence_mark(confidence)) : status;
}

Sheet answer(const RingFit& fit, const Question& question, unsigned threads, Progress& progress)
{
  const auto& [weave, lookup, registry] = fit.source();
  Sheet sheet;
  sheet.question = question;
  sheet.weave = weave;
  sheet.ratio = question.inner / question.wire;
  sheet.fitting = fit.fitting(question);
  sheet.chain = weave.ways.size() == 1;
  Job job = job_of(weave, question, 0.0, lookup, registry);
  const SceneSpec& scene = job.prepared->scene;
  const double cells = sheet.chain
                           ? metre / pitch_along(scene.lattice, weave.ways[0].degrees)
                           : square_decimetre / std::abs(scene.lattice[0].cross(scene.lattice[1]).z());
  sheet.rings = cells * static_cast<double>(scene.elements.size());
  for (const PlacedElement& element : scene.elements) sheet.metal += cells * wire_volume(scene, element);
  std::vector<LimitResult> limits = limits_of(job, threads, "limits", progress);
  sheet.ways = answers(job, weave, limits);
  if (!sheet.chain) sheet.thickness = thickness(scene);
  sheet.rest_gap =
      smallest_gap(job.prepared->model, rest_state(job.prepared->model), far) * job.prepared->model.length;
  sheet.printable = question.gap > 0.0 && fit.fits(thicker(question));
  if (question.gap > 0.0 && !sheet.printable) sheet.largest_gap = largest_gap(fit, question);
  if (question.gap > 0.0 && !question.small && !sheet.printable)
    sheet.inner_of_gap = fit.fitting(thicker(question)).inner.value_or(Range()).low + question.gap;
  if (sheet.printable) {
    const Job apart = job_of(weave, question, question.gap, lookup, registry);
    sheet.with_gap = answers(apart, weave, limits_of(apart, threads, "limits with the gap", progress));
  }
  // Last, as it takes longest: what is known by then stays.
  if (question.roll && !sheet.chain)
    sheet.rolls = rolls(weave, question, scene.lattice, lookup, registry, threads, progress);
  sheet.cut_short = question.roll && !sheet.chain && interrupted();
  sheet.job = std::make_shared<const Job>(solved(std::move(job), std::move(limits)));
  return sheet;
}

const std::vector<Metal>& metals()
{
  static const std::vector<Metal> table{
      {"aluminium", 2.70}, {"titanium", 4.51}, {"steel", 7.85},  {"stainless steel", 8.00},
      {"brass", 8.50},     {"bronze", 8.80},   {"copper", 8.96}, {"sterling silver", 10.36}};
  return table;
}

std::string shown_marks(const Sheet& sheet)
{
  std::string out;
  const auto add = [&out](const std::optional<double>& value, const std::string& confidence) {
    if (value) out += confidence_mark(confidence);
  };
  for (const auto* ways : {&sheet.ways, &sheet.with_gap})
    for (const WayAnswer& way : *ways) {
      add(way.stretch, way.stretch_confidence);
      add(way.compress, way.compress_confidence);
    }
  for (const RollAnswer& roll : sheet.rolls) {
    add(roll.up, roll.up_confidence);
    add(roll.down, roll.down_confidence);
  }
  return out;
}

std::string explained_marks_of_sheets(const std::string& marks)
{
  const bool contradicted = marks.find('!') != std::string::npos;
  return explained_marks(marks) +
         (contradicted
              ? "! contradicted by another limit; `hauberk run` of the experiment (-o) says by which\n"
              : "");
}

std::string sheet_text(const Sheet& sheet)
{
  const Question& q = sheet.question;
  std::string text = fmt::format("{}: {}\n", sheet.weave.name, sheet.weave.description);
  if (q.small)
    text += fmt::format(
        "large rings of {:.4g} mm inner diameter and {:.4g} mm wire, small ones of {:.4g} mm and {:.4g} mm: ratios {:.3f} "
        "and {:.3f}\n  with the other sizes as they are it takes {}\n\n",
        q.inner, q.wire, q.small->inner, q.small->wire, sheet.ratio, q.small->inner / q.small->wire,
        fitting_text(sheet.fitting));
  else
    text += fmt::format(
        "rings of {:.4g} mm inner diameter, wire of {:.4g} mm: ratio {:.3f}, at least {:.3f} is needed\n"
        "  it takes {}\n\n",
        q.inner, q.wire, sheet.ratio, sheet.weave.smallest_ratio, fitting_text(sheet.fitting));
  text += "the pattern repeats itself every\n" + ways_text(sheet.ways) + "\n" + shapes_text(sheet) +
          rolls_text(sheet.rolls);
  const double weight = 1e-3 * sheet.metal;  // cm^3 per dm^2 or metre
  const char* per = sheet.chain ? "m" : "dm^2";
  text += fmt::format("{:.1f} rings per {} at rest{}, {:.3f} mm apart at least; grams per {}:", sheet.rings,
                      per, q.small ? ", as many of each size" : "", sheet.rest_gap, per);
  const char* separator = " ";
  for (const Metal& metal : metals()) {
    text += fmt::format("{}{} {:.1f}", separator, metal.name, weight * metal.density);
    separator = ", ";
  }
  text += "\n\n";
  const std::string marks = explained_marks_of_sheets(shown_marks(sheet));
  if (!(q.gap > 0.0)) return text + marks;
  if (!sheet.printable) {
    text += marks + (marks.empty() ? "" : "\n");
    text += fmt::format("printed with a gap of {:g} mm it has no room; these rings leave {:.3f} mm", q.gap,
                        std::floor(1e3 * sheet.largest_gap) / 1e3);
    if (q.small) return text + "\n";
    return text +
           fmt::format(", and it takes rings from {:.3f} mm on\n", std::ceil(1e3 * sheet.inner_of_gap) / 1e3);
  }
  text += fmt::format("with surfaces {:g} mm apart at all times, every\n", q.gap) + ways_text(sheet.with_gap);
  return text + (marks.empty() ? "" : "\n") + marks;
}

boost::json::object sheet_json(const Sheet& sheet)
{
  namespace json = boost::json;
  const Question& q = sheet.question;
  json::object grams;
  for (const Metal& metal : metals()) grams[metal.name] = 1e-3 * sheet.metal * metal.density;
  json::object out{{"weave", sheet.weave.name},
                   {"inner_mm", q.inner},
                   {"wire_mm", q.wire},
                   {"ratio", sheet.ratio},
                   {"smallest_ratio", sheet.weave.smallest_ratio},
                   {"fitting", fitting_json(sheet.fitting)},
                   {"ways", ways_json(sheet.ways)},
                   {"rolls", rolls_json(sheet.rolls)},
                   {"thickness_mm", sheet.chain ? json::value(nullptr) : json::value(sheet.thickness)},
                   {"rest_gap_mm", sheet.rest_gap},
                   {"rings", sheet.rings},
                   {"per", sheet.chain ? "m" : "dm2"},
                   {"grams", std::move(grams)}};
  if (q.gap > 0.0) {
    out["gap_mm"] = q.gap;
    out["printable"] = sheet.printable;
    if (!sheet.printable) out["largest_gap_mm"] = sheet.largest_gap;
    out["with_gap"] = ways_json(sheet.with_gap);
  }
  if (q.small) out["small"] = json::object{{"inner_mm", q.small->inner}, {"wire_mm", q.small->wire}};
  return out;
}

}  // namespace hauberk::maker
