#include "run/progress.hpp"

#include "document/plain_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace hauberk {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds redraw_interval{100};
constexpr std::chrono::seconds plain_interval{5};
constexpr std::size_t bar_width = 30;
constexpr std::size_t assumed_columns = 80;

std::size_t columns()
{
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1) return size.ws_col;
  return assumed_columns;
}

std::string bar(std::size_t done, std::size_t total)
{
  const std::size_t filled = total == 0 ? bar_width : bar_width * done / total;
  return "[" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "]";
}

void put(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

/// Names come from files and plugins.
void put_line(const std::string& text) { put(plain_text(text) + "\n"); }

}  // namespace

Progress::Mode Progress::detect(bool quiet)
{
  if (quiet) return Mode::quiet;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::strcmp(terminal, "dumb") == 0;
  return isatty(STDERR_FILENO) != 0 && !dumb ? Mode::terminal : Mode::plain;
}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

void Progress::erase()
{
  if (drawn_ > 0) put(fmt::format("\x1b[{}A\r\x1b[J", drawn_));
  drawn_ = 0;
}

void Progress::draw(const std::vector<std::string>& lines)
{
  erase();
  const std::size_t width = columns() - 1;  // a wrapped line would count as two
  for (const std::string& line : lines) put_line(line.substr(0, width));
  drawn_ = lines.size();
  std::fflush(stderr);
}

void Progress::note(const std::string& text)
{
  if (mode_ != Mode::quiet) warn(text);
}

void Progress::warn(const std::string& text)
{
  const std::lock_guard lock(mutex_);
  erase();
  put(plain_text(text, LineBreaks::kept) + "\n");
}

void Progress::limits(const std::string& label, std::size_t done, std::size_t total)
{
  const bool ends = done == 0 || done == total;
  line(ends, [&](bool terminal) {
    return terminal ? fmt::format("{} {} {}/{}", label, bar(done, total), done, total)
                    : fmt::format("{}: {}/{}", label, done, total);
  });
}

void Progress::lessons(const std::string& label, int round, std::size_t done, std::size_t total)
{
  line(false, [&](bool) {
    return fmt::format("{}: going on from locked states, round {}, {}/{}", label, round, done, total);
  });
}

void Progress::checks(const std::string& name, std::size_t done, std::size_t total)
{
  if (mode_ == Mode::plain && Clock::now() - begin_ < plain_interval) return;
  line(false, [&](bool terminal) {
    return terminal ? fmt::format("{} {}/{} {}", bar(done, total), done, total, name)
                    : fmt::format("{}/{} done, running {}", done, total, name);
  });
}

void Progress::line(bool always, const std::function<std::string(bool terminal)>& text)
{
  if (mode_ == Mode::quiet) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool terminal = mode_ == Mode::terminal;
  if (!always && now - last_ < (terminal ? redraw_interval : plain_interval)) return;
  if (terminal)
    draw({fmt::format("{}  {:.1f} s", text(terminal), seconds())});
  else
    put(fmt::format("{} ({:.1f} s)\n", text(terminal), seconds()));
  last_ = now;
}

namespace {

std::string clearances(const DesignIterate& it)
{
  constexpr double visible = 1e-6;
  std::string text = std::isfinite(it.min_gap) ? fmt::format("smallest distance at rest {:.4g}", it.min_gap)
                                               : std::string("nothing close at rest");
  if (it.constraint_violation > visible)
    text += fmt::format(", clearances violated by {:.2g}", it.constraint_violation);
  return text;
}

}  // namespace

void Progress::design(const DesignProgress& progress, const DesignSpec& design, bool final)
{
  if (mode_ == Mode::quiet) return;
  const DesignIterate& it = *progress.iterate;
  const std::lock_guard lock(mutex_);
  const std::string head =
      fmt::format("design: {}start {}/{}, iteration {}, objective {:.4e}", final ? "refining " : "",
                  progress.start + 1, progress.starts, it.iteration, it.objective) +
      (it.changed.empty() ? "" : fmt::format(" (another state: {})", fmt::join(it.changed, "; ")));
  if (mode_ == Mode::plain) {
    std::vector<std::string> values;
    for (const double v : it.values) values.push_back(fmt::format("{:.4f}", v));
    put(fmt::format("{}, step {:.2g}, {}, {}: {} ({:.1f} s)\n", head, it.step, clearances(it),
                    design.quantity_name, fmt::join(values, " "), seconds()));
    return;
  }
  std::vector<std::string> lines{
      fmt::format("{}  {:.1f} s", head, seconds()), fmt::format("  step {:.2g}, {}", it.step, clearances(it)),
      fmt::format("  {:>10} {:>10} {:>10} {:>9}", "direction", "target", design.quantity_name, "off by")};
  for (std::size_t k = 0; k < it.values.size() && k < design.targets.size(); ++k) {
    const DesignTarget& t = design.targets[k];
    const double off = t.value != 0.0 ? 100.0 * miss(t.aim, t.value, it.values[k]) / std::abs(t.value) : 0.0;
    lines.push_back(
        fmt::format("  {:>10g} {:>10.4f} {:>10.4f} {:>7.1f} %", t.direction_deg, t.value, it.values[k], off));
  }
  draw(lines);
}

void Progress::clear()
{
  const std::lock_guard lock(mutex_);
  erase();
  std::fflush(stderr);
}

}  // namespace hauberk
