#include "tasks/design/evaluation_log.hpp"

#include <fmt/format.h>
#include <boost/crc.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view format_name = "hauberk-evaluations/4 ";
constexpr std::string_view end_of_line = " .";  ///< of a whole one
constexpr char evaluation_mark = 'E';
constexpr char states_mark = 'S';

/// CRC-32 of a line up to here, as the line has it.
std::string checksum(std::string_view text)
{
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format(" {:08x}", crc.checksum());
}

/// What a whole line says, without its checksum and its end; null where it is not what was written.
std::optional<std::string> undamaged(std::string_view line)
{
  constexpr std::size_t sum_length = 9;
  line.remove_suffix(end_of_line.size());
  if (line.size() < sum_length) return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - sum_length);
  if (text.empty() || checksum(text) != line.substr(text.size())) return std::nullopt;
  return std::string(text);
}

/// Same bits: 0 and -0 are different designs, and nothing is nearly the same.
bool same(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

class Writer {
 public:
  explicit Writer(char mark) : text_(1, mark) {}

  template <class Number>
  void number(Number x)
  {
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
    text_ += ' ';
    text_.append(buffer.data(), end);
  }
  void numbers(const double* x, std::size_t n)
  {
    number(n);
    for (std::size_t i = 0; i < n; ++i) number(x[i]);
  }
  void numbers(const std::vector<double>& x) { numbers(x.data(), x.size()); }
  void numbers(const Vector& x) { numbers(x.data(), static_cast<std::size_t>(x.size())); }
  /// Characters that end a word are written as numbers.
  void words(const std::string& s)
  {
    text_ += " '";
    for (const char c : s) {
      if (c <= ' ' || c == '%')
        text_ += fmt::format("%{:02x}", static_cast<unsigned char>(c));
      else
        text_ += c;
    }
  }
  std::string line() &&
  {
    text_ += checksum(text_);
    return std::move(text_.append(end_of_line));
  }

 private:
  std::string text_;
};

/// Reads what a Writer wrote; `good` turns false where it did not.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  template <class Number>
  Number number()
  {
    Number x{};
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    good = good && error == std::errc{} && end == word.data() + word.size();
    return good ? x : Number{};
  }
  std::vector<double> numbers()
  {
    const auto n = number<std::size_t>();
    good = good && n <= text_.size();  // a number takes more than one character
    std::vector<double> x(good ? n : 0);
    for (double& v : x) v = number<double>();
    return x;
  }
  Vector vector()
  {
    const std::vector<double> x = numbers();
    return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  std::string words()
  {
    std::string_view word = next();
    good = good && word.starts_with('\'');
    std::string s;
    for (std::size_t i = 1; good && i < word.size(); ++i) {
      if (word[i] != '%') {
        s += word[i];
        continue;
      }
      unsigned code = 0;
      good = i + 2 < word.size() &&
             std::from_chars(word.data() + i + 1, word.data() + i + 3, code, 16).ec == std::errc{};
      s += static_cast<char>(code);
      i += 2;
    }
    return s;
  }

  bool good = true;

 private:
  std::string_view next()
  {
    const std::size_t begin = text_.find_first_not_of(' ');
    if (begin == std::string_view::npos) {
      good = false;
      return {};
    }
    text_.remove_prefix(begin);
    const std::string_view word = text_.substr(0, text_.find(' '));
    text_.remove_prefix(word.size());
    return word;
  }

  std::string_view text_;
};

}  // namespace

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
    write(std::string(format_name) + std::string(identity));
  }
}

bool EvaluationLog::read(std::string_view identity)
{
  std::ifstream in(file_, std::ios::binary);
  if (!in) return false;
  std::size_t position = 0;
  std::string line;
  if (!std::getline(in, line) || in.eof() || line != std::string(format_name) + std::string(identity))
    return false;
  position += line.size() + 1;
  while (std::getline(in, line) && !in.eof() && line.ends_with(end_of_line)) {
    std::optional<std::string> text = undamaged(line);
    if (!text) {
      warn_(fmt::format("warning: {}: line {} is damaged; it and what follows are computed again",
                        file_.string(), lines_.size() + 2));
      break;
    }
    known_ += text->front() == evaluation_mark ? 1 : 0;
    lines_.push_back({position, std::move(*text)});
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
  Reader in(std::string_view(lines_[next_].text).substr(1));
  DesignPoint found;
  found.x = in.numbers();
  evaluations = in.number<long>();
  found.evaluated = in.number<int>() != 0;
  found.continued = in.number<int>() != 0;
  found.why = in.words();
  for (const double k : in.numbers()) found.changed.push_back(static_cast<int>(k));
  found.values = in.numbers();
  found.objective = in.number<double>();
  found.gradient = in.vector();
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

void EvaluationLog::record(const DesignPoint& p, long evaluations)
{
  forget();
  closest_points_ += evaluations;
  Writer out(evaluation_mark);
  out.numbers(p.x);
  out.number(evaluations);
  out.number(p.evaluated ? 1 : 0);
  out.number(p.continued ? 1 : 0);
  out.words(p.why);
  out.numbers(std::vector<double>(p.changed.begin(), p.changed.end()));
  out.numbers(p.values);
  out.number(p.objective);
  out.numbers(p.gradient);
  if (p.evaluated)
    out.numbers(p.value_gradients.data(), static_cast<std::size_t>(p.value_gradients.size()));
  else
    out.numbers(std::vector<double>(p.values.size() * p.x.size(), 0.0));
  write(std::move(out).line());
}

bool EvaluationLog::recall_states(DesignPoint& p)
{
  if (next_ >= lines_.size() || lines_[next_].text.front() != states_mark) return false;
  Reader in(std::string_view(lines_[next_].text).substr(1));
  const std::vector<double> x = in.numbers();
  const auto tasks = in.number<std::size_t>();
  std::vector<std::vector<WarmStart>> warm(tasks <= lines_[next_].text.size() ? tasks : 0);
  for (std::vector<WarmStart>& stages : warm) {
    const auto count = in.number<std::size_t>();
    for (std::size_t k = 0; k < count && in.good; ++k) {
      WarmStart w;
      w.g_hat = in.number<double>();
      w.state.macro = in.vector();
      w.state.e = in.vector();
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
  Writer out(states_mark);
  out.numbers(p.x);
  out.number(p.warm.size());
  for (const std::vector<WarmStart>& stages : p.warm) {
    out.number(stages.size());
    for (const WarmStart& w : stages) {
      out.number(w.g_hat);
      out.numbers(w.state.macro);
      out.numbers(w.state.e);
      std::vector<double> rotations;
      for (const Mat3& Q : w.state.rotation) rotations.insert(rotations.end(), Q.data(), Q.data() + 9);
      out.numbers(rotations);
    }
  }
  write(std::move(out).line());
}

}  // namespace hauberk
