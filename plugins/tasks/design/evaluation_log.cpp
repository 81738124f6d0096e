#include "tasks/design/evaluation_log.hpp"

#include "document/record_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

/// Limits that a design can have.
constexpr int most_tasks = 1000000;
constexpr char evaluation_mark = 'E';
constexpr char states_mark = 'S';

/// Same bits: 0 and -0 are different designs, and nothing is nearly the same.
bool same(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

std::span<const double> all_of(const Vector& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

Vector vector(const std::vector<double>& x)
{
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace

std::string EvaluationLog::first_line(std::string_view identity)
{
  return std::string("hauberk-evaluations/4 ") + std::string(identity);
}

EvaluationLog::EvaluationLog(fs::path file, std::string_view identity, bool go_on, Warn warn)
    : file_(std::move(file)), warn_(std::move(warn))
{
  // A link or a pipe of that name is somebody else's: it is neither read nor written through, and makes way.
  std::error_code unknown;
  if (const fs::file_status there = fs::symlink_status(file_, unknown);
      fs::exists(there) && !fs::is_regular_file(there))
    fs::remove(file_, unknown);
  if (go_on && read(identity)) {
    out_.open(file_, std::ios::binary | std::ios::app);
  } else {
    lines_.clear();
    known_ = 0;
    out_.open(file_, std::ios::binary | std::ios::trunc);
    write(first_line(identity));
  }
}

bool EvaluationLog::read(std::string_view identity)
{
  std::ifstream in(file_, std::ios::binary);
  if (!in) return false;
  std::size_t position = 0;
  std::string line;
  if (!std::getline(in, line) || in.eof() || line != first_line(identity)) return false;
  position += line.size() + 1;
  while (std::getline(in, line) && !in.eof() && line.ends_with(end_of_record)) {
    const std::optional<std::string_view> text = undamaged_record(line);
    if (!text) {
      warn_(fmt::format("warning: {}: line {} is damaged; it and what follows are computed again",
                        file_.string(), lines_.size() + 2));
      break;
    }
    known_ += text->front() == evaluation_mark ? 1 : 0;
    lines_.push_back({position, std::string(*text)});
    position += line.size() + 1;
  }
  in.close();
  std::error_code error;
  fs::resize_file(file_, position, error);  // what a kill cut off
  return !error;
}

void EvaluationLog::write(const std::string& line)
{
  if (!out_.is_open()) return;
  out_ << line << '\n' << std::flush;
  if (out_.good()) return;
  out_.close();
  warn_(fmt::format(
      "warning: {}: cannot be written; going on, but a search that is interrupted will be repeated from its "
      "last evaluation that was written",
      file_.string()));
}

void EvaluationLog::forget()
{
  if (next_ >= lines_.size()) return;
  std::error_code error;
  fs::resize_file(file_, lines_[next_].begin, error);
  if (error) out_.close();  // nothing may be appended to what is wrong
  lines_.clear();
  next_ = 0;
}

bool EvaluationLog::recall(DesignPoint& p, long& evaluations)
{
  // Warm starts that nobody asked for belong to an evaluation that was not accepted this time.
  if (next_ >= lines_.size() || lines_[next_].text.front() != evaluation_mark) {
    forget();
    return false;
  }
  RecordReader in(std::string_view(lines_[next_].text).substr(1));
  DesignPoint found;
  found.x = in.numbers();
  evaluations = in.number<long>();
  found.evaluated = in.number<int>() != 0;
  found.continued = in.number<int>() != 0;
  found.why = in.words();
  for (const double k : in.numbers()) {
    in.good = in.good && k >= 0.0 && k < static_cast<double>(most_tasks) && k == std::floor(k);
    found.changed.push_back(in.good ? static_cast<int>(k) : 0);
  }
  found.values = in.numbers();
  found.objective = in.number<double>();
  found.gradient = vector(in.numbers());
  const std::vector<double> gradients = in.numbers();
  if (!in.good || !same(found.x, p.x) || gradients.size() != found.values.size() * p.x.size()) {
    forget();
    return false;
  }
  p.evaluated = found.evaluated;
  p.continued = found.continued;
  p.why = std::move(found.why);
  p.changed = std::move(found.changed);
  p.values = std::move(found.values);
  p.objective = found.objective;
  p.gradient = std::move(found.gradient);
  p.value_gradients = Eigen::Map<const Matrix>(gradients.data(), static_cast<Eigen::Index>(p.values.size()),
                                               static_cast<Eigen::Index>(p.x.size()));
  lines_[next_].text.assign(1, evaluation_mark);
  ++next_;
  closest_points_ += evaluations;
  return true;
}

std::string evaluation_record(const DesignPoint& p, long evaluations)
{
  RecordWriter out(evaluation_mark);
  out.numbers(p.x);
  out.number(evaluations);
  out.number(p.evaluated ? 1 : 0);
  out.number(p.continued ? 1 : 0);
  out.words(p.why);
  out.numbers(std::vector<double>(p.changed.begin(), p.changed.end()));
  out.numbers(p.values);
  out.number(p.objective);
  out.numbers(all_of(p.gradient));
  if (p.evaluated)
    out.numbers({p.value_gradients.data(), static_cast<std::size_t>(p.value_gradients.size())});
  else
    out.numbers(std::vector<double>(p.values.size() * p.x.size(), 0.0));
  return out.text();
}

void EvaluationLog::record(const DesignPoint& p, long evaluations)
{
  forget();
  closest_points_ += evaluations;
  write(record_line(evaluation_record(p, evaluations)));
}

bool EvaluationLog::recall_states(DesignPoint& p)
{
  if (next_ >= lines_.size() || lines_[next_].text.front() != states_mark) return false;
  RecordReader in(std::string_view(lines_[next_].text).substr(1));
  const std::vector<double> x = in.numbers();
  const auto tasks = in.number<std::size_t>();
  std::vector<std::vector<WarmStart>> warm(tasks <= lines_[next_].text.size() ? tasks : 0);
  for (std::vector<WarmStart>& stages : warm) {
    const auto count = in.number<std::size_t>();
    for (std::size_t k = 0; k < count && in.good; ++k) {
      WarmStart w;
      w.g_hat = in.number<double>();
      w.state.macro = vector(in.numbers());
      w.state.e = vector(in.numbers());
      const std::vector<double> rotations = in.numbers();
      for (std::size_t r = 0; r + 9 <= rotations.size(); r += 9)
        w.state.rotation.emplace_back(Eigen::Map<const Mat3>(rotations.data() + r));
      in.good = in.good && w.state.rotation.size() == p.rest.rotation.size() &&
                w.state.macro.size() == p.rest.macro.size() && w.state.e.size() == p.rest.e.size();
      stages.push_back(std::move(w));
    }
  }
  if (!in.good || !same(x, p.x) || warm.size() != tasks) {
    forget();
    return false;
  }
  p.warm = std::move(warm);
  lines_[next_].text.assign(1, states_mark);
  ++next_;
  return true;
}

void EvaluationLog::record_states(const DesignPoint& p)
{
  forget();
  RecordWriter out(states_mark);
  out.numbers(p.x);
  out.number(p.warm.size());
  for (const std::vector<WarmStart>& stages : p.warm) {
    out.number(stages.size());
    for (const WarmStart& w : stages) {
      out.number(w.g_hat);
      out.numbers(all_of(w.state.macro));
      out.numbers(all_of(w.state.e));
      std::vector<double> rotations;
      for (const Mat3& Q : w.state.rotation) rotations.insert(rotations.end(), Q.data(), Q.data() + 9);
      out.numbers(rotations);
    }
  }
  write(std::move(out).line());
}

}  // namespace hauberk
