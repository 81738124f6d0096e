#pragma once
/// What a running computation shows: a block that is redrawn on a terminal, plain lines elsewhere, or
/// nothing.

#include "design/design.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace hauberk {

/// Writes to stderr, so that stdout holds nothing but the summary. Thread safe.
class Progress {
 public:
  enum class Mode { quiet, plain, terminal };
  explicit Progress(Mode mode) : mode_(mode) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Terminal if stderr is one that can move the cursor, else plain.
  static Mode detect(bool quiet);

  /// A line that stays.
  void note(const std::string& text);
  /// The same for what must be seen even where no progress is asked for.
  void warn(const std::string& text);
  /// Limits done of all.
  void limits(const std::string& label, std::size_t done, std::size_t total);
  /// Limits that learn from each other, in rounds. Written as seldom as everything else between ends.
  void lessons(const std::string& label, int round, std::size_t done, std::size_t total);
  /// The check that runs, and how many are done; elsewhere than on a terminal not of what is quick.
  void checks(const std::string& name, std::size_t done, std::size_t total);
  /// An iterate of the design, with the table of its targets; `final`: the best start is being continued.
  void design(const DesignProgress& progress, const DesignSpec& design, bool final);
  /// Removes the redrawn block.
  void clear();

 private:
  /// One line with the time, unless the last one was written just now.
  void line(bool always, const std::function<std::string(bool terminal)>& text);
  void draw(const std::vector<std::string>& lines);
  void erase();
  double seconds() const;

  Mode mode_;
  std::mutex mutex_;
  std::size_t drawn_ = 0;  ///< lines of the block on the screen
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace hauberk
