#include "part_run.hpp"

#include "dispatch.hpp"
#include "run/code_digest.hpp"
#include "run/interrupt.hpp"
#include "run/machine.hpp"
#include "run/provenance.hpp"
#include "run/sha256.hpp"
#include "say.hpp"

#include <fmt/format.h>

#include <unistd.h>
#include <array>

namespace hauberk::command {

Share part_of(const Options& options)
{
  for (const char* other : {"force", "resume", "take-over"}) {
    if (options.has(other))
      throw UsageError(fmt::format("--{}: not of a part, which goes on from what was computed of it", other),
                       options.usage());
  }
  try {
    return share_named(options.get<std::string>("part"));
  } catch (const InputError& error) {
    throw UsageError(fmt::format("--part: {}", error.what()), options.usage());
  }
}

Division division_of(const Options& options, const Job& job, std::size_t count)
{
  Division d{count,
             identity_of(job),
             std::filesystem::absolute(options.positional()).lexically_normal().string(),
             options.list("set"),
             {}};
  // Nodes do not have this process's environment.
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : options.list("plugin-path")) folders.emplace_back(folder);
  d.libraries = named_plugin_folders(folders);
  return d;
}

std::string identity_of(const Job& job)
{
  Sha256 hash;
  // Versions are not enough: two builds of one may round differently.
  hash.add(code_digest());
  hash.add(identity(*job.prepared, provenance(*job.prepared, 1, job.task->measures_time())));
  return hash.digest();
}

LogOrigin log_origin(const std::string& part)
{
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return {"", part, this_machine().processor, fmt::format("{}:{}", host.data(), ::getpid())};
}

void refuse_whole(const Job& job)
{
  if (const std::string why = job.task->why_whole(); !why.empty())
    throw InputError(fmt::format("the task '{}' cannot be divided: {}", job.prepared->experiment.task, why));
}

int run_part(Job& job, const Share& share, const Options& options, const RunRequest& request)
{
  refuse_whole(job);
  const std::filesystem::path folder = part_path(request.folder, share);
  const Division division = division_of(options, job, share.count);
  enter_division(request.folder, division);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), failed.message()));
  Progress progress(Progress::detect(request.quiet));
  SearchLogs logs(division.identity, [&](const std::string& warning) { progress.warn(warning); });
  for (const std::filesystem::path& file : logs_in(folder, searches_name)) {
    const std::optional<SearchLogs::Contents> contents = logs.read(file);
    if (!contents || !contents->complete) continue;
    say("part {}: complete already\n", part_name(share));
    return exit_done;
  }
  if (logs.known() > 0)
    progress.note(fmt::format("going on: {} searches of this part are known", logs.known()));
  logs.write_to(folder, searches_name, log_origin(part_name(share)));
  const auto nothing = [] {};
  RunContext context{request.threads,
                     progress,
                     folder,
                     false,
                     [&] { return identity(*job.prepared, provenance(*job.prepared, 1, false)); },
                     nothing,
                     nothing,
                     nothing,
                     &logs};
  try {
    job.task->run_part(context, share);
  } catch (const InputError& error) {  // what is bad input was refused before
    throw ComputationError(error.what());
  }
  progress.clear();
  if (interrupted()) {
    say("part {}: interrupted; the same command goes on\n", part_name(share));
    return exit_interrupted;
  }
  if (!logs.complete())
    throw ComputationError(fmt::format("{}: cannot be written: is the disk full?", folder.string()));
  say("part {}: done, in {}; `hauberk gather {}` joins all\n", part_name(share), folder.string(),
      request.folder.string());
  return exit_done;
}

}  // namespace hauberk::command
