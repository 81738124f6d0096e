#pragma once
/// Scenes of benchmarks: experiment files, read as the program reads them.

#include "model/model.hpp"
#include "tasks/job.hpp"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hauberk::bench {

/// An experiment file of the checkout and what is set in it.
struct Source {
  std::string file;              ///< relative to the checkout
  std::vector<std::string> set;  ///< as --set takes it

  /// What `hauberk run` is to be given to compute the same, quoted for a shell.
  std::string arguments() const;
};

/// The materials of the publication's table 1.
inline constexpr std::array materials{"chainmail", "threefold", "fourfold"};

/// The experiment with all limits of one of them, as changed by `set`.
Source published_limits(const std::string& material, std::vector<std::string> set = {});

/// An experiment that is ready to be computed.
struct Scene {
  Job job;
  const Prepared& prepared() const { return *job.prepared; }
};

/// Reads scenes when they are first asked for, each once. Not thread safe.
class Scenes {
 public:
  Scenes();
  /// Valid as long as this is. Throws what the reader throws.
  const Scene& at(const Source& source);

 private:
  std::shared_ptr<const Registry> registry_;
  std::map<std::string, Scene> scenes_;
};

}  // namespace hauberk::bench
