#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "part_run.hpp"
#include "run/folder_lock.hpp"
#include "say.hpp"
#include "shell_words.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <sys/wait.h>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

constexpr const char *part_script = "part.sh", *array_script = "array.sh", *gather_script = "gather.sh",
                     *steps_script = "steps.sh";
constexpr int default_resubmissions = 2;

/// Slurm reads quotes, backslashes and % of a path in a job script in its own way.
void refuse_for_slurm(const fs::path& path)
{
  const std::size_t bad = path.string().find_first_of("\"\\%\n");
  if (bad == std::string::npos) return;
  const char c = path.string()[bad];
  throw InputError(fmt::format("{}: job scripts cannot name a folder with {} in it; give another with -o",
                               path.string(),
                               c == '\n' ? std::string("a line break") : fmt::format("'{}'", c)));
}

struct Submission {
  Division division;
  fs::path folder;  ///< of the results, absolute
  std::string program, name;
  std::vector<std::string> options;  ///< for sbatch
  int resubmissions = default_resubmissions;
  bool steps = false;

  fs::path script(const char* file) const { return folder / parts_folder / file; }
  std::string head(const std::string& output) const;
  std::string part() const;
  std::string set_gather() const;
  std::string array() const;
  std::string gather() const;
  std::string one_job() const;
};

std::string Submission::head(const std::string& output) const
{
  std::string text = "#!/bin/sh\n";
  text += fmt::format("#SBATCH --job-name=hauberk\n#SBATCH --requeue\n#SBATCH --output=\"{}/{}\"\n",
                      (folder / parts_folder).string(), output);
  if (steps) text += fmt::format("#SBATCH --ntasks={}\n", division.count);
  for (const std::string& option : options) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

std::string Submission::part() const
{
  std::string command = fmt::format("{} run {}", shell_quoted(program), shell_quoted(division.experiment));
  for (const std::string& set : division.set) command += fmt::format(" --set {}", shell_quoted(set));
  for (const std::string& path : division.libraries)
    command += fmt::format(" --plugin-path {}", shell_quoted(path));
  return fmt::format(
      "#!/bin/sh\n"
      "# One part of {}: of an array its index, of a job's steps its rank.\n"
      "part=${{SLURM_ARRAY_TASK_ID:-$((SLURM_PROCID + 1))}}\n"
      "exec {} --part \"$part/{}\" -o {} --quiet\n",
      division.count, command, division.count, shell_quoted(folder.string()));
}

std::string Submission::array() const
{
  return head("array-%A_%a.out") +
         fmt::format("exec /bin/sh {}\n", shell_quoted(script(part_script).string()));
}

/// The command that gathers, in the variable `gather` of a script's positional parameters. A job that the
/// scheduler has begun again takes the folder from its former self, whichever node that was on.
std::string Submission::set_gather() const
{
  return fmt::format(
      "folder={}\n"
      "set -- {} gather \"$folder\" --quiet\n"
      "if [ \"${{SLURM_RESTART_COUNT:-0}}\" -gt 0 ] && [ -f \"$folder/{}\" ]; then\n"
      "  set -- \"$@\" --take-over \"$(cut -d' ' -f1,2 \"$folder/{}\" | tr ' ' ':')\"\n"
      "fi\n",
      shell_quoted(folder.string()), shell_quoted(program), lock_file, lock_file);
}

std::string Submission::gather() const
{
  return head("gather-%j.out") +
         fmt::format(
             "# Joins the parts. Those that are missing are submitted again, so many times:\n"
             "left=${{1:-{}}}\n"
             "{}missing=$(\"$@\" --missing) || exit\n"
             "if [ -n \"$missing\" ] && [ \"$left\" -gt 0 ]; then\n"
             "  echo \"parts $missing are missing: they are submitted again\"\n"
             "  job=$(sbatch --parsable --array=\"$missing\" {}) || exit\n"
             "  sbatch --parsable --dependency=\"afterany:${{job%%;*}}\" {} $((left - 1))\n"
             "  exit\n"
             "fi\n"
             "exec \"$@\"\n",
             resubmissions, set_gather(), shell_quoted(script(array_script).string()),
             shell_quoted(script(gather_script).string()));
}

std::string Submission::one_job() const
{
  return head("steps-%j.out") +
         fmt::format(
             "# All parts as one step of this job; those that are missing after it once more, so many times:\n"
             "left={}\n"
             "export SRUN_CPUS_PER_TASK=\"${{SLURM_CPUS_PER_TASK:-1}}\"\n"
             "{}while missing=$(\"$@\" --missing) && [ -n \"$missing\" ] && [ \"$left\" -ge 0 ]; do\n"
             "  srun --kill-on-bad-exit=0 /bin/sh {}\n"
             "  left=$((left - 1))\n"
             "done\n"
             "exec \"$@\"\n",
             resubmissions, set_gather(), shell_quoted(script(part_script).string()));
}

/// What a command prints, up to its first line break. Throws ComputationError where it fails; what it says of
/// that it has said on stderr.
std::string output_of(const std::string& command)
{
  std::fflush(nullptr);
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw ComputationError(fmt::format("cannot start: {}", command));
  std::string text;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  const int status = ::pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || text.empty())
    throw ComputationError(fmt::format(
        "the scheduler did not take a job (status {}); the scripts stay, and what is left to submit is: {}",
        WIFEXITED(status) ? WEXITSTATUS(status) : -1, command));
  return text.substr(0, text.find('\n'));
}

/// Number of a job, without its cluster.
std::string submit(const std::string& arguments)
{
  const std::string answer = output_of("sbatch --parsable " + arguments);
  return answer.substr(0, answer.find(';'));
}

std::size_t parts_of(const Options& options, const char* name)
{
  const int n = options.get<int>(name);
  if (n < 1 || static_cast<std::size_t>(n) > most_parts)
    throw UsageError(fmt::format("--{}: expected a number from 1 to {}, found {}", name, most_parts, n),
                     options.usage());
  return static_cast<std::size_t>(n);
}

std::string this_program()
{
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? "hauberk" : program.string();
}

Submission submission_of(const Options& options)
{
  if (options.has("array") == options.has("steps"))
    throw UsageError("give either --array N or --steps N", options.usage());
  Submission s;
  s.steps = options.has("steps");
  s.division = {parts_of(options, s.steps ? "steps" : "array"), {}, {}, {}, {}};
  s.folder = fs::absolute(output_folder(options)).lexically_normal();
  s.program = this_program();
  s.options = options.list("sbatch");
  for (const std::string& option : s.options) {
    if (!option.starts_with('-') || option.find('\n') != std::string::npos)
      throw UsageError(
          fmt::format("--sbatch: expected an option of sbatch, such as --time=1:00:00, found '{}'", option),
          options.usage());
  }
  if (options.has("resubmit")) s.resubmissions = options.get<int>("resubmit");
  if (s.resubmissions < 0 || s.resubmissions > 100)
    throw UsageError("--resubmit: expected a number from 0 to 100", options.usage());
  return s;
}

}  // namespace

Description submit_description()
{
  return {
      .name = "submit",
      .form = "EXPERIMENT.json --engine slurm --array N [-o DIR] [--dry-run]",
      .line = "compute an experiment in parts on a cluster",
      .synopsis = "submit EXPERIMENT.json --engine slurm (--array N | --steps N) [options]",
      .summary =
          "Checks an experiment, writes job scripts for its parts into the folder `parts` of DIR, and submits "
          "them: an array of one job per part (see `run --part`), and a job that begins when all have ended, "
          "however they ended, submits again those that are missing, and gathers them (see `gather`).",
      .more =
          "All nodes have to see the program, the experiment and DIR at the same places. The job that gathers "
          "submits from a node.",
      .arguments = {experiment_argument()},
      .options = joined(
          {{.name = "engine",
            .takes = Takes::text,
            .value = "NAME",
            .help = "the scheduler",
            .offer = Offer::words,
            .choices = {"slurm"}},
           {.name = "array",
            .takes = Takes::integer,
            .value = "N",
            .help = "an array of N jobs, one per part"},
           {.name = "steps",
            .takes = Takes::integer,
            .value = "N",
            .help = "one job with N parts as tasks of a step (`srun`), which gathers them itself",
            .more =
                "For few parts that take long, such as the starts of a design whose evaluations are dear."},
           {.name = "output",
            .letter = 'o',
            .takes = Takes::text,
            .value = "DIR",
            .help = "folder for the results; default: out/NAME-OF-THE-FILE",
            .offer = Offer::folders},
           {.name = "sbatch",
            .takes = Takes::texts,
            .value = "OPTION",
            .help = "an option for sbatch in every job, such as `--sbatch=--time=1:00:00`; repeatable"},
           {.name = "resubmit",
            .takes = Takes::integer,
            .value = "N",
            .help = "how many times parts that are missing are computed again; default: 2"},
           {.name = "dry-run", .help = "write the scripts and print how to submit them, and submit nothing"}},
          experiment_options())};
}

int submit_command(const std::vector<std::string>& words)
{
  Options options(submit_description());
  options.parse(words);
  if (!options.has("engine") || options.get<std::string>("engine") != "slurm")
    throw UsageError("--engine: expected slurm", options.usage());
  Submission s = submission_of(options);
  refuse_for_slurm(s.folder);
  const Job job = open_job(options);
  refuse_whole(job);
  warn_of_plugins(*job.prepared);
  s.division = division_of(options, job, s.division.count);
  const fs::path scripts = s.folder / parts_folder;
  enter_division(s.folder, s.division);
  std::vector<NamedContent> files{{part_script, s.part()}};
  if (s.steps) {
    files.push_back({steps_script, s.one_job()});
  } else {
    files.push_back({array_script, s.array()});
    files.push_back({gather_script, s.gather()});
  }
  write_files_atomically(scripts, files, {});

  const std::string array =
      fmt::format("--array=1-{} {}", s.division.count, shell_quoted(s.script(array_script).string()));
  const auto gather = [&s](const std::string& after) {
    return fmt::format("--dependency=afterany:{} {}", after, shell_quoted(s.script(gather_script).string()));
  };
  const std::string steps = shell_quoted(s.script(steps_script).string());
  if (options.has("dry-run")) {
    say("scripts in {}; submit them with\n", scripts.string());
    if (s.steps)
      say("  sbatch {}\n", steps);
    else
      say("  job=$(sbatch --parsable {}) && sbatch {}\n", array, gather("${job%%;*}"));
    return exit_done;
  }
  if (s.steps) {
    say("job {}: {} parts as its steps, and gathering them\n", submit(steps), s.division.count);
  } else {
    const std::string first = submit(array);
    say("job {}: {} parts\n", first, s.division.count);
    say("job {}: gathering them\n", submit(gather(first)));
  }
  say("results will be in {}; messages of the jobs are in {}\n", s.folder.string(), scripts.string());
  return exit_done;
}

}  // namespace hauberk::command
