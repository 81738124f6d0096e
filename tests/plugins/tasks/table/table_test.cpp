#include "tasks/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace hauberk {
namespace {

TEST(TaskTable, EveryTaskIsThereOnceWithFilesOfItsOwnAndASection)
{
  std::set<std::string> names, files;
  for (const Task& task : all_tasks()) {
    EXPECT_TRUE(names.insert(std::string(task.name)).second) << task.name;
    EXPECT_NE(task.prepare, nullptr) << task.name;
    EXPECT_EQ(&task_named(task.name), &task);
    for (const char* file : task.file_names) {
      EXPECT_NE(std::string(file), "results.json");
      files.insert(file);
    }
  }
  for (const TaskFormat& format : task_formats()) {
    EXPECT_TRUE(names.contains(std::string(format.name))) << format.name << " is a section of no task";
    EXPECT_EQ(format.field().name, format.name);
  }
  // Only limits have no section: they are what an experiment is by itself.
  EXPECT_EQ(task_formats().size() + 1, names.size());
  const std::vector<const char*> all = result_names();
  for (const std::string& file : files) EXPECT_NE(std::find(all.begin(), all.end(), file), all.end()) << file;
}

}  // namespace
}  // namespace hauberk
