#pragma once
/// The fabric that the words of a command name: of an experiment, of results, of a folder of results.

#include "experiment_options.hpp"
#include "export/fabric.hpp"

#include <boost/json/value.hpp>

#include <string>

namespace hauberk::command {

/// A file, and the fabric that it speaks of.
struct Opened {
  std::string file;
  boost::json::value results;  ///< null of an experiment
  Job job;                     ///< of the experiment, also of that in results
  exporting::Fabric fabric;
};

/// By the options --state, --row, --set and those of experiments. Throws InputError where the file has not
/// what they ask for, and what `prepare_job` throws.
Opened open_fabric(const Options& options);

}  // namespace hauberk::command
