#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "maker/weave_comparison.hpp"
#include "maker/wire_length.hpp"
#include "run/interrupt.hpp"
#include "run/machine.hpp"
#include "run/weave_library.hpp"
#include "say.hpp"
#include "shell_words.hpp"
#include "weave_files.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <optional>

namespace hauberk::command {
namespace {

double length_option(const Options& options, const char* name, const char* fallback)
{
  if (!options.has(name) && fallback == nullptr)
    throw UsageError(fmt::format("--{}: expected a length, as 8mm, 5/16in or 18awg", name), options.usage());
  return maker::millimetres(options.has(name) ? options.get<std::string>(name) : fallback,
                            fmt::format("--{}", name));
}

/// The small rings that are asked for, none of a weave of one size.
std::optional<maker::Ring> small_rings(const Options& options, const maker::Weave& weave, double wire)
{
  if (!weave.two_sizes) {
    for (const char* name : {"small-inner", "small-wire"})
      if (options.has(name))
        throw UsageError(
            fmt::format("--{}: '{}' is woven of rings of one size; leave it out", name, weave.name),
            options.usage());
    return std::nullopt;
  }
  if (!options.has("small-inner"))
    throw UsageError(
        fmt::format("--small-inner: '{}' is woven of rings of two sizes; give the inner diameter of the "
                    "small ones, too",
                    weave.name),
        options.usage());
  return maker::Ring{length_option(options, "small-inner", nullptr),
                     options.has("small-wire") ? length_option(options, "small-wire", nullptr) : wire};
}

/// Why the rings cannot be woven, and which could.
std::string no_room_text(const maker::RingFit& fit, const maker::Question& question)
{
  const maker::Weave& weave = fit.source().weave;
  const std::string ranges = maker::fitting_text(fit.fitting(question));
  const std::string way_out =
      ranges.empty() ? "no other size of one of them alone would do"
                     : (question.small ? "with the others as they are it takes " : "take ") + ranges;
  if (question.small)
    return fmt::format("{}: {} leave no room for each other; {}", weave.name, maker::rings_text(question),
                       way_out);
  return fmt::format(
      "{}: rings of {:.4g} mm are too small for wire of {:.4g} mm (ratio {:.3f}, at least {:.3f} is needed); {}",
      weave.name, question.inner, question.wire, question.inner / question.wire, weave.smallest_ratio,
      way_out);
}

/// `weave all`: those that are woven of plain rings, of two sizes where small ones are given.
int compare_weaves(const Options& options, const maker::Question& asked)
{
  for (const char* name : {"output", "force", "roll", "gap"})
    if (options.has(name))
      throw UsageError(fmt::format("--{}: of one weave; leave it out, or name the weave", name),
                       options.usage());
  if (options.has("small-wire") && !options.has("small-inner"))
    throw UsageError("--small-wire: give the inner diameter of the small rings with --small-inner, too",
                     options.usage());
  const WeaveLookup lookup = weave_lookup("weave.json");
  const std::shared_ptr<const Registry> registry = open_registry(options);
  std::vector<maker::Compared> all;
  Progress progress(Progress::detect(false));
  for (const std::string& name : library_weaves()) {
    maker::Question question = asked;
    question.weave = name;
    question.gap = 0.0;
    maker::Compared one;
    try {
      one.weave = maker::read_weave(name, lookup);
    } catch (const InputError&) {  // not woven of plain rings
      continue;
    }
    if (one.weave.two_sizes && !options.has("small-inner")) {
      one.why_not = "rings of two sizes; give the inner diameter of the small ones with --small-inner";
      all.push_back(std::move(one));
      continue;
    }
    if (one.weave.two_sizes) question.small = small_rings(options, one.weave, question.wire);
    const maker::RingFit fit({one.weave, lookup, registry});
    if (fit.fits(question)) {
      one.sheet = maker::answer(fit, question, available_processors(), progress);
    } else {
      const std::string ranges = maker::fitting_text(fit.fitting(question));
      one.why_not = ranges.empty() ? "no room" : "no room; take " + ranges;
    }
    all.push_back(std::move(one));
  }
  progress.clear();
  if (options.has("json"))
    say_json(write_json(maker::comparison_json(all)));
  else
    say("{}", maker::comparison_text(all, asked));
  return exit_done;
}

}  // namespace

Description weave_description()
{
  return {
      .name = "weave",
      .form = "{NAME | all} --inner LENGTH --wire LENGTH",
      .line = "a maker's answers: room, stretch, weight of a weave",
      .synopsis = "weave {NAME | all} --inner LENGTH --wire LENGTH [options]",
      .summary =
          "Says whether a weave can be made of rings of this inner diameter and wire, for which it could, how long it "
          "is at rest, taut and pushed together, what it weighs, and what a printer's gap leaves of it. "
          "Lengths as 8mm, 0.8cm, 5/16in, 18awg (American) or 18swg (British gauge).",
      .more =
          "Weaves are box, byzantine, chain, dragonscale, european_4in1, european_6in1, full_persian_6in1, "
          "half_persian_3in1, half_persian_4in1, japanese_4in1, japanese_6in1, or a file of one's own; `all` "
          "compares those of the library. Exit code 1 where the rings of one leave no room for each other.",
      .arguments = {{.name = "NAME", .optional = true}},
      .options = {
          {.name = "inner", .takes = Takes::text, .value = "LENGTH", .help = "inner diameter of the rings"},
          {.name = "wire", .takes = Takes::text, .value = "LENGTH", .help = "diameter of their wire"},
          {.name = "small-inner",
           .takes = Takes::text,
           .value = "LENGTH",
           .help = "of a weave of two sizes: inner diameter of the small rings"},
          {.name = "small-wire",
           .takes = Takes::text,
           .value = "LENGTH",
           .help = "diameter of their wire; default that of the large ones"},
          {.name = "gap",
           .takes = Takes::text,
           .value = "LENGTH",
           .help = "that a printer needs between surfaces; default 0.4mm"},
          {.name = "roll",
           .help =
               "also how tightly it is wound onto a rod, each way and side; a minute or two, ten and more for loose rings; Ctrl-C keeps the other answers"},
          {.name = "output",
           .letter = 'o',
           .takes = Takes::text,
           .value = "DIR",
           .help = "folder for the answers and the experiment that they come from",
           .offer = Offer::folders},
          {.name = "force", .help = "replace answers that the folder holds"},
          json_option(),
          plugin_path_option()}};
}

int weave_command(const std::vector<std::string>& words)
{
  catch_interrupts();
  Options options(weave_description());
  options.parse(words);
  if (options.positionals().empty())
    throw UsageError(fmt::format("NAME is missing; the library has {}", fmt::join(library_weaves(), ", ")),
                     options.usage());
  if (options.positionals().size() > 1)
    throw UsageError(fmt::format("one NAME expected, found also '{}'", options.positionals()[1]),
                     options.usage());
  maker::Question question;
  question.weave = options.positional();
  question.inner = length_option(options, "inner", nullptr);
  question.wire = length_option(options, "wire", nullptr);
  if (question.weave == "all") return compare_weaves(options, question);
  question.gap = length_option(options, "gap", "0.4mm");
  question.roll = options.has("roll");
  const WeaveLookup lookup = weave_lookup("weave.json");
  const maker::Weave weave = maker::read_weave(question.weave, lookup);
  question.small = small_rings(options, weave, question.wire);
  const maker::RingFit fit({weave, lookup, open_registry(options)});
  if (!fit.fits(question)) throw ComputationError(no_room_text(fit, question));
  if (question.roll && weave.ways.size() == 1)
    throw UsageError(
        fmt::format("--roll: '{}' is a chain, which has no width to be wound; leave it out", weave.name),
        options.usage());
  const bool kept = options.has("output");
  const std::filesystem::path folder = kept ? options.get<std::string>("output") : "";
  const std::vector<const char*> names = weave_file_names();
  if (kept) prepare_output_directory(folder, options.has("force"), names);
  Progress progress(Progress::detect(false));
  const unsigned threads = available_processors();
  const maker::Sheet sheet = maker::answer(fit, question, threads, progress);
  progress.clear();
  if (options.has("json"))
    say_json(write_json(maker::sheet_json(sheet)));
  else
    say("{}", maker::sheet_text(sheet));
  if (sheet.cut_short) say_error("hauberk: interrupted: not all rolls are known\n");
  const int code = sheet.cut_short ? exit_interrupted : exit_done;
  if (!kept) return code;
  write_files_atomically(folder, weave_files(sheet, folder, threads), names);
  drop_previous(folder, names);
  if (!options.has("json"))
    say("\nwritten to {0}: weave.html is this page with pictures; `hauberk export {0} -o {1}.3mf` prints it, and "
        "experiment.json runs again\n",
        shell_word(folder.string()), weave.name);
  return code;
}

}  // namespace hauberk::command
