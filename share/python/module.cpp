/// The extension hauberk._hauberk: experiments in and results out as JSON text. What is pleasant to use is in
/// the package beside it, hauberk/__init__.py.

#include "callback_optimizer.hpp"
#include "document/atomic_file.hpp"
#include "document/json_text.hpp"
#include "run/interrupt.hpp"
#include "run/provenance.hpp"
#include "run/weave_library.hpp"
#include "tasks/job.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/stored_shapes.hpp>
#include <hauberk/host/search_path.hpp>
#include <hauberk/verify/verify.hpp>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace py = pybind11;
using namespace hauberk;

/// What every call has: the experiment, and where plugins and weaves are.
struct Source {
  std::string text, file;
  std::vector<std::string> overrides, plugin_folders;
  std::string
      root;  ///< of the installation: plugins and weaves are found from its folder bin, as the program's are
  std::shared_ptr<const Optimizer> optimizer = {};  ///< of the caller; may be null
};

std::shared_ptr<const Registry> registry_of(const Source& source)
{
  const std::vector<fs::path> folders(source.plugin_folders.begin(), source.plugin_folders.end());
  return std::make_shared<Registry>(
      plugin_search_path(folders, std::getenv("HAUBERK_PLUGIN_PATH"), fs::path(source.root) / "bin/hauberk"));
}

Job job_of(const Source& source)
{
  return prepare_job(registry_of(source), {source.file,
                                           source.text,
                                           source.overrides,
                                           weave_lookup(fs::path(source.file).parent_path(),
                                                        fs::path(source.root) / "share/hauberk/weaves"),
                                           {},
                                           {},
                                           source.optimizer});
}

using ProblemTuple = std::tuple<int, std::string, std::string>;

/// Line, pointer, message of every problem.
std::vector<ProblemTuple> problems_of(const Source& source)
{
  const py::gil_scoped_release free;
  try {
    job_of(source);
    return {};
  } catch (const ReportedProblems& error) {
    std::vector<ProblemTuple> out;
    for (const Problem& p : error.problems()) out.emplace_back(p.line, p.pointer, p.message);
    return out;
  } catch (const InputError& error) {
    return {{0, "", error.what()}};
  }
}

std::pair<std::string, std::string> plan_of(const Source& source)
{
  const py::gil_scoped_release free;
  const Job job = job_of(source);
  ShownPlan shown = show_plan(job);
  return {std::move(shown.text), write_json(boost::json::value(std::move(shown.document)))};
}

/// A folder that is gone when this is.
class TemporaryFolder {
 public:
  TemporaryFolder()
  {
    std::string name = (fs::temp_directory_path() / "hauberk-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw ComputationError("no folder can be made in " + name);
    path_ = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What a run comes to.
struct Outcome {
  std::string results, summary;
  bool failed = false, was_interrupted = false;
};

/// `optimizer`: None, or a function that designs are searched with.
Outcome run(Source source, unsigned threads, const std::string& output, bool force, bool show_progress,
            const py::object& optimizer)
{
  // It holds an object of Python: the last one to let go of it is `source`, which goes with the lock held.
  if (!optimizer.is_none()) source.optimizer = callback_optimizer(py::cast<py::function>(optimizer));
  const py::gil_scoped_release free;
  const InterruptScope signals;
  const Job job = job_of(source);
  const std::vector<const char*> names = result_names();
  if (!output.empty()) prepare_output_directory(output, force, names);
  const TemporaryFolder own;
  Progress progress(show_progress ? Progress::detect(false) : Progress::Mode::quiet);
  const Provenance origin = provenance(*job.prepared, threads, job.task->measures_time());
  const auto nothing = [] {};
  RunContext context{threads, progress, own.path(), false, [&] { return identity(*job.prepared, origin); },
                     nothing, nothing,  nothing};
  job.task->run(context);
  progress.clear();
  boost::json::object document = blank_document(job, origin);
  std::vector<NamedContent> files =
      result_content(job, output.empty() ? own.path() : fs::path(output), document, {});
  if (!output.empty()) write_files_atomically(output, files, names);
  return {files.back().content, job.task->summary(), job.task->failed(), interrupted()};
}

std::pair<bool, std::string> verify_text(const std::string& results, const std::string& file,
                                         const Source& source)
{
  const py::gil_scoped_release free;
  const std::shared_ptr<const Registry> registry = registry_of(source);
  const VerifyReport report = verify(parse_json(results, file), {}, StoredShapes(lookup_in(*registry)));
  return {report.ok, report.text()};
}

}  // namespace

PYBIND11_MODULE(_hauberk, m)
{
  m.doc() = "Experiments in and results out, as JSON text.";
  py::class_<Source>(m, "Source")
      .def(py::init<std::string, std::string, std::vector<std::string>, std::vector<std::string>,
                    std::string>(),
           py::arg("text"), py::arg("file"), py::arg("overrides"), py::arg("plugin_folders"),
           py::arg("root"));
  py::class_<Outcome>(m, "Outcome")
      .def_readonly("results", &Outcome::results)
      .def_readonly("summary", &Outcome::summary)
      .def_readonly("failed", &Outcome::failed)
      .def_readonly("interrupted", &Outcome::was_interrupted);
  static py::exception<InputError> input_error(m, "InputError", PyExc_ValueError);
  static py::exception<ComputationError> computation_error(m, "ComputationError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const InputError& problem) {
      input_error(problem.what());
    } catch (const ComputationError& problem) {
      computation_error(problem.what());
    }
  });
  bind_problem(m);
  m.def("problems", &problems_of);
  m.def("plan", &plan_of);
  m.def("run", &run);
  m.def("verify", &verify_text);
}
