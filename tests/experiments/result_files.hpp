#pragma once
/// What a run leaves in its folder, and whether it is whole.

#include "program.hpp"

#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace hauberk::test {

using Contents = std::map<std::string, std::string>;

/// Files of a folder by name; none where there is no folder.
Contents contents(const std::filesystem::path& folder);

/// The same but for the times of the run.
Contents results_in(const std::filesystem::path& folder);

/// Without names that begin with a dot: what a killed program has not yet given its name.
Contents without_temporaries(Contents files);

/// Every result is whole: JSON that parses, a table whose rows are equally long, a picture that is closed.
void expect_whole(const Contents& files, const std::string& what);

/// Puts a document into a folder of partial results as if a run had left it.
void write_partial_results(const std::filesystem::path& folder, const boost::json::value& document);

/// Never done: a limit with very many starts beside one that is decided at once.
std::string endless_text();

/// An experiment of each kind.
struct TaskCase {
  const char* name;
  std::string (*text)();
};

const std::vector<TaskCase>& task_cases();

std::ostream& operator<<(std::ostream& out, const TaskCase& task);

}  // namespace hauberk::test
